#include "tests/fuzz/calls.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "sfsm/rivals/rivals.h"

namespace sfsm::fuzz {
namespace {

using Limits = std::numeric_limits<double>;
constexpr std::array hostile = {
    Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), 0.0,    -0.0, -1.0,   1e30,   -1e30,
    Limits::max(),       Limits::lowest(),   Limits::min(),       1e-300, 1e-9, 4000.0, 1e-100, Limits::denorm_min()};

// Bytes as numbers; zeros when they have run out.
class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    bool is_empty() const { return bytes_.empty(); }

    std::uint8_t byte() {
        if (bytes_.empty()) return 0;
        const std::uint8_t value = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return value;
    }

    // Half of them near `usual`, a quarter hostile, a quarter any bits.
    double number(double usual) {
        const std::uint8_t kind = byte();
        if (kind < 128) return usual * (0.5 + kind / 85.0);
        if (kind < 192) return hostile[kind % hostile.size()];
        return std::bit_cast<double>(word());
    }

    std::int64_t count() {
        const std::uint8_t kind = byte();
        return kind < 192 ? 100 * std::int64_t{kind} : static_cast<std::int64_t>(word());
    }

private:
    std::uint64_t word() {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
        return bits;
    }

    std::span<const std::uint8_t> bytes_;
};

struct HostileForecast {
    std::array<Step, 4> motion, shapes;
    std::array<RateStep, 4> rates;
    Forecast forecast;

    explicit HostileForecast(Reader& reader) {
        const std::size_t motion_count = reader.byte() % (motion.size() + 1);
        const std::size_t shape_count = reader.byte() % (shapes.size() + 1);
        for (std::size_t i = 0; i < motion_count; ++i) {
            motion[i] = {reader.number(150), Work{0, 0, 0, reader.count()}, reader.number(1)};
        }
        for (std::size_t i = 0; i < shape_count; ++i) {
            shapes[i] = {reader.number(4), Work{0, reader.count(), reader.count()}, reader.number(1)};
        }
        const std::size_t rate_count = reader.byte() % (rates.size() + 1);
        for (std::size_t i = 0; i < rate_count; ++i) {
            rates[i] = {reader.number(1e-6),
                        static_cast<State>(reader.byte() % 3),
                        reader.number(150),
                        reader.number(4),
                        Work{0, reader.count(), reader.count(), reader.count(), 0, 0, reader.count()},
                        reader.number(0.1)};
        }
        forecast = {Work{reader.count(), 0, 0, 0, reader.count(), reader.count()},
                    std::span(motion).first(motion_count), std::span(shapes).first(shape_count),
                    std::span(rates).first(rate_count)};
    }
};

// One law under calls.
class Caller {
public:
    Caller(Controller& law, Forecasts forecasts) : law_(law), forecasts_(forecasts) {}

    void call(Reader& reader) {
        const std::uint8_t action = reader.byte() % 8;
        FrameSample sample{++frame_, 0, decision_, {}};
        switch (action) {
            case 0:  // a hostile time of a hostile decision
                sample.decision = {static_cast<State>(reader.byte() % 3), reader.number(150), reader.number(4),
                                   reader.number(1e-6)};
                [[fallthrough]];
            case 1:  // frames running backwards, hostile work
                sample.frame = reader.count();
                sample.work = {reader.count(), reader.count(), reader.count(), reader.count()};
                [[fallthrough]];
            case 2:
                sample.ms = reader.number(16);
                law_.observe(sample);
                break;
            case 3: {
                const double ms = reader.number(16);
                decide({ms, reader.number(200)});
                break;
            }
            case 4: {
                const HostileForecast forecast(reader);
                decide({16, 200, forecasts_ == Forecasts::hostile ? &forecast.forecast : nullptr});
                break;
            }
            default:  // an ordinary frame of an ordinary renderer
                sample.ms = 4 + reader.byte() / 8.0;
                law_.observe(sample);
                decide({16, 200});
        }
    }

    Outcome outcome;

private:
    void decide(const FrameRequest& request) {
        if (std::isfinite(request.range) && request.range > 0) range_ = request.range;
        decision_ = law_.decide(request);
        for (const double value :
             {static_cast<double>(decision_.state), decision_.motion_distance, decision_.splat_size, decision_.rate}) {
            outcome.hash = (outcome.hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;  // FNV-1a by words
        }
        if (outcome.broken.empty()) outcome.broken = broken_rule();
    }

    std::string broken_rule() const {
        const Decision& d = decision_;
        const Status& status = law_.status();
        if (d.state < State::original || d.state > State::points) return "no such state";
        if (!(d.splat_size >= 0 && d.splat_size <= max_splat_size)) return "S out of range";
        if ((d.splat_size > 0) != (d.state == State::points)) return "S belongs to state 2";
        if (!(d.motion_distance > 0)) return "D is not over 0";
        if (!(d.rate >= 0 && std::isfinite(d.rate))) return "no such rate";
        if (d.state != State::original && d.motion_distance > range_) return "D is over L";
        if (!(status.decision == d)) return "status shows another decision";
        if (!std::isfinite(status.target_ms) || !std::isfinite(status.last_ms)) return "status is not finite";
        return status.reason == nullptr ? "no reason" : "";
    }

    Controller& law_;
    Forecasts forecasts_;
    Decision decision_;
    double range_ = unknown_range;  // or the last usable one
    std::int64_t frame_ = 0;
};

}  // namespace

Outcome call(Controller& law, std::span<const std::uint8_t> bytes, Forecasts forecasts) {
    Caller caller(law, forecasts);
    for (Reader reader(bytes); !reader.is_empty();) caller.call(reader);
    return caller.outcome;
}

std::vector<std::string_view> all_names() {
    std::vector<std::string_view> names(law_names().begin(), law_names().end());
    names.insert(names.end(), rival_names().begin(), rival_names().end());
    return names;
}

std::unique_ptr<Controller> make_any(std::string_view name) {
    const auto laws = law_names();
    return std::find(laws.begin(), laws.end(), name) != laws.end() ? make_controller(name) : make_rival(name);
}

}  // namespace sfsm::fuzz
