// How fast recordings are read [bytes/s], from memory on one thread: bin/recordings_bench
#include <benchmark/benchmark.h>

#include <sstream>
#include <streambuf>
#include <string>

#include "sfsm/number_text.h"
#include "sfsm/recordings/recording.h"
#include "tests/sfsm/steps.h"

namespace sfsm {
namespace {

constexpr int million = 1'000'000;

// Bytes read where they are: a string stream would copy them.
class Bytes : public std::streambuf {
public:
    explicit Bytes(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

// 16 ms and a little that changes, with four decimals as the tools write them.
std::string changing_ms(std::int64_t row, int salt) {
    const std::int64_t parts = 160000 + (row * 7919 + salt * 104729) % 20000;
    return number_text(static_cast<double>(parts) / 1e4);
}

std::string presentmon_rows(int rows, int streams) {
    std::string text =
        "Application,ProcessID,SwapChainAddress,PresentRuntime,SyncInterval,PresentFlags,AllowsTearing,PresentMode,"
        "FrameType,CPUStartQPC,FrameTime,CPUBusy,CPUWait,GPULatency,GPUTime,GPUBusy,GPUWait,VideoBusy,DisplayLatency,"
        "DisplayedTime,AnimationError,AnimationTime,MsFlipDelay,AllInputToPhotonLatency,ClickToPhotonLatency\n";
    for (int i = 0; i < rows; ++i) {
        text += "Game" + std::to_string(i % streams) +
                ".exe,24892,0x2A70D2CAC00,DXGI,0,0,0,Hardware: Independent Flip,Application,2466961521260," +
                changing_ms(i, 1) + ',' + changing_ms(i, 2) + ",0.5269,1.1731,10.1685," + changing_ms(i, 3) +
                ",8.6018,0.0000,28.1718,16.6267,0.8487,1939.5329,NA,NA,NA\n";
    }
    return text;
}

// Rows of about 1.5 KB, most of it a forecast.
std::string our_rows(int rows) {
    TraceRow row;
    for (int i = 1; i <= 24; ++i)
        row.motion.push_back(sfsm::motion_step(8.123456789 * i, 7919 * i, 0.123456789012345 * i));
    for (int i = 1; i <= 20; ++i) {
        row.shapes.push_back(sfsm::shape_step(0.7071067811865476 * i, 104729 * i, 99991 * i, 0.314159265358979 / i));
    }
    row.work = {12000, 3456789, 987654, 4321};
    std::ostringstream out;
    write_trace_header(out, {{"law", "predictive"}});
    for (row.frame = 0; row.frame < rows; ++row.frame) {
        row.target_ms = row.frame_ms = 16.683217 + 1e-6 * static_cast<double>(row.frame % 1000);
        write_trace_row(out, row);
    }
    return out.str();
}

void read_all(benchmark::State& state, std::string text, int rows) {
    for (auto _ : state) {
        Bytes bytes(text);
        std::istream in(&bytes);
        benchmark::DoNotOptimize(read_recording(in, "bench").frames.size());
    }
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
    state.SetItemsProcessed(state.iterations() * rows);
}

void presentmon(benchmark::State& state) {
    read_all(state, presentmon_rows(million, static_cast<int>(state.range(0))), million);
}
BENCHMARK(presentmon)->Arg(1)->Arg(8)->ArgName("streams")->Unit(benchmark::kMillisecond);

void our_trace(benchmark::State& state) {
    read_all(state, our_rows(million / 20), million / 20);
}
BENCHMARK(our_trace)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sfsm
