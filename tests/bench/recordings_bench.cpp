// How fast recordings are read [bytes/s]: bin/recordings_bench. From memory on one thread; and a file of a million
// rows, all the way to the figures of an open loop, beside a plain read of it. Files are written to the temporary
// folder.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <streambuf>
#include <string>

#include "sfsm/number_text.h"
#include "sfsm/predictive.h"
#include "sfsm/recordings/recording.h"
#include "sfsm/replay.h"
#include "sfsm/summary.h"
#include "tests/command.h"
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

// A million rows of 236 bytes, cached as it has just been written.
class BigFile {
public:
    BigFile() : path_(folder_ / "big.csv") {
        std::ofstream file(path_, std::ios::binary);
        file << "Application,ProcessID,SwapChainAddress,PresentRuntime,SyncInterval,PresentFlags,AllowsTearing,"
                "PresentMode,"
                "FrameType,CPUStartTime,FrameTime,CPUBusy,CPUWait,GPULatency,GPUTime,GPUBusy,GPUWait,VideoBusy,"
                "DisplayLatency,DisplayedTime,AnimationError,AnimationTime,MsFlipDelay,AllInputToPhotonLatency,"
                "ClickToPhotonLatency\n";
        for (int i = 0; i < million; ++i) {
            file << "Cyberpunk2077.exe,24892,0x000002A70D2CAC00,DXGI,0,512,1,Hardware Composed: Independent "
                    "Flip,Application,"
                 << 1000000 + 16 * i << ".1250," << changing_ms(i, 1) << ',' << changing_ms(i, 2)
                 << ",0.526900,1.173100,10.168500," << changing_ms(i, 3) << ",8.601800,0.0000,28.171800,"
                 << changing_ms(i, 4) << ",0.8487," << 1000000 + 16 * i << ".5329,0.0000,NA,NA\n";
        }
        file.close();
        size_ = static_cast<std::int64_t>(std::filesystem::file_size(path_));
    }
    const std::string& path() const { return path_; }
    std::int64_t size() const { return size_; }

private:
    tests::Directory folder_;
    std::string path_;
    std::int64_t size_ = 0;
};

const BigFile& big_file() {
    static const BigFile file;
    return file;
}

void set_bytes(benchmark::State& state) {
    state.counters["MB/s"] =
        benchmark::Counter(static_cast<double>(big_file().size()) / 1e6, benchmark::Counter::kIsIterationInvariantRate);
}

// The program itself: its whole time, and the most memory that it had. The first of all, as a child begins with what
// its parent had.
void program(benchmark::State& state) {
    const std::string path = big_file().path(), json = path + ".json", binary = GRANDSTAND_BIN "/replay";
    const std::vector<std::string> words = {"replay", path, "--open-loop", "--json", json};
    long peak_kb = 0;
    for (auto _ : state) {
        std::vector<char*> arguments;
        for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
        arguments.push_back(nullptr);
        posix_spawn_file_actions_t quiet;
        posix_spawn_file_actions_init(&quiet);
        posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        pid_t child = 0;
        int status = posix_spawn(&child, binary.c_str(), &quiet, nullptr, arguments.data(), environ);
        posix_spawn_file_actions_destroy(&quiet);
        rusage used{};
        if (status != 0 || wait4(child, &status, 0, &used) != child || tests::code_of(status) != 0) {
            state.SkipWithError(("cannot run " + binary).c_str());
            break;
        }
        peak_kb = std::max(peak_kb, used.ru_maxrss);
    }
    set_bytes(state);
    state.counters["peak_of_file"] = 1024.0 * static_cast<double>(peak_kb) / static_cast<double>(big_file().size());
}
BENCHMARK(program)->Unit(benchmark::kMillisecond)->UseRealTime();

void plain_read(benchmark::State& state) {
    const std::string& path = big_file().path();
    std::vector<char> block(std::size_t{64} << 10);
    for (auto _ : state) {
        const int file = open(path.c_str(), O_RDONLY);
        while (read(file, block.data(), block.size()) > 0) benchmark::DoNotOptimize(block.data());
        close(file);
    }
    set_bytes(state);
}
BENCHMARK(plain_read)->Unit(benchmark::kMillisecond);

// What the program does, without its second thread.
void open_loop(benchmark::State& state) {
    const std::string& path = big_file().path();
    for (auto _ : state) {
        std::ifstream in(path, std::ios::binary);
        const Recording recording = read_recording(in, path);
        TraceRow row;
        row.target_ms = 16.6;
        PredictiveLaw law;
        Replaying replaying(law, 2);
        std::vector<FrameTime> times;
        for (const FrameRecord& frame : recording.frames) {
            row.frame_ms = frame.frame_ms;
            times.push_back({row.target_ms, frame.frame_ms, replaying.next(row).decision.state});
            ++row.frame;
        }
        benchmark::DoNotOptimize(summary_json(summarize_times(times), {}, {}).data());
    }
    set_bytes(state);
}
BENCHMARK(open_loop)->Unit(benchmark::kMillisecond);

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
