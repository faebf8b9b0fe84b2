// What a frame costs, learned from frames: time = gain * sum over terms of price * amount. Prices say how kinds of work
// compare. The gain follows all that makes every frame slower or faster: clocks, other programs, a crowd that grew
// without a forecast. No clock, no allocation; the same calls give the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sfsm/noise_memory.h"
#include "sfsm/shift.h"
#include "sfsm/tail.h"

namespace sfsm {

inline constexpr int most_terms = 9;

// Amounts of each kind of work in a frame, in units whose expected prices are equal. Term 0 is what every frame has.
struct Amounts {
    std::array<double, most_terms> of{};  // >= 0, finite; of[0] > 0
    int terms = 0;                        // the same for all that one model is given

    bool operator==(const Amounts&) const = default;
};

struct Prediction {
    double log_ms = 0;       // natural logarithm of the time [ms]
    double uncertainty = 0;  // 1 sigma of log_ms without the noise of a single frame, >= 0: 0.1 is about 10 %
};

// What is believed before the first time: each price is 1, give or take its spread.
struct PriceBelief {
    int terms = 1;                            // in [1, most_terms]
    std::array<double, most_terms> spread{};  // 1 sigma of each price, > 0
    double likeness = 0;                      // correlation of neighbours among terms 1, 2, ..., [0, 1)
    std::array<double, most_terms> least{};   // lowest price of each, [0, 1); over 0: it surely isn't free
};

// An extended Kalman filter. It estimates ln gain and the prices from the logarithm of each time.
// - Outliers are weighed down (Huber).
// - Prices never fall below 0.
// - It forgets slowly (a random walk), but never becomes less sure than it was at first.
// - Sudden changes are found by a detector of shifts and are the gain's.
class CostModel {
public:
    explicit CostModel(const PriceBelief& belief);

    // A frame of these amounts took `ms` (finite, > 0). A time that is off by a factor of 20 or more is a pause, a
    // loading screen or a dragged window. It is not believed before the eighth in a row.
    void observe(const Amounts& amounts, double ms);

    // What was learned of the prices has proved wrong: they are believed as at first, and a frame of these amounts to
    // have taken `ms`. Noise and tail stay.
    void relearn(const Amounts& amounts, double ms);

    // Mean nothing before is_ready(). log_ms() is the prediction's, for less than half of its cost.
    Prediction predict(const Amounts& amounts) const;
    double log_ms(const Amounts& amounts) const;

    // Two times have arrived; one alone may be the hitch of a program's first frame.
    bool is_ready() const { return samples_ >= 2; }

    double gain() const;                                            // 1 at the start
    double price(int term) const;                                   // [ms] per unit of amount, gain left out
    double price_uncertainty(int term) const;                       // 1 sigma [ms]
    std::array<double, most_terms> cost_sigmas() const;             // 1 sigma of gain() * price(term) [ms]
    double noise() const { return noise_ * memory_.of_a_frame(); }  // 1 sigma of a single frame, relative
    double tail() const { return tail_.excess(); }                  // Tail::percentile of ln(time / prediction)
    std::int64_t shifts() const { return shifts_; }                 // of level, that were found so far
    std::int64_t samples() const { return samples_; }

    // Moves ln gain by so much.
    void nudge(double log_gain);

private:
    static constexpr int most_states = most_terms + 1;
    using Vector = std::array<double, most_states>;
    struct Seen {
        Amounts amounts;
        double log_ms = 0;
    };

    void believe();
    void start(const Amounts& amounts, double ms);
    double cost_of(const Amounts& amounts) const;  // in units of gain and scale_
    double log_time(const Amounts& amounts, Vector& gradient) const;
    double correct(const Seen& seen);
    double surprise(double standardised) const;
    bool is_strange(const Seen& seen) const;
    // Of noise without memory of which a mean of frames is as uncertain.
    double mean_noise() const { return noise_ * memory_.of_a_mean(); }
    void limit();
    void forget();
    void fold_gain();
    void learn_noise(const Seen& seen);
    void take_shift(int count);
    void recall(double log_gain, double variance);

    PriceBelief belief_;
    int states_;
    Vector state_{};                            // ln gain, then prices in units of scale_
    std::array<Vector, most_states> spread_{};  // their covariance
    double log_scale_ = 0, scale_ = 1;          // ln [ms] per unit of amount at price 1, and without the ln
    double noise_ = 0;                          // 1 sigma of the differences of neighbours / sqrt(2)
    double last_residual_ = 0;
    int strange_ = 0;    // times in a row that were absurdly off
    int residuals_ = 0;  // that told of the noise so far; counts to a thousand
    std::int64_t samples_ = 0;
    std::int64_t shifts_ = 0;
    double left_log_gain_ = 0, left_variance_ = -1;  // of the level before the last shift; < 0: there was none
    NoiseMemory memory_;
    Tail tail_;
    ShiftDetector detector_;
    std::array<Seen, ShiftDetector::window> recent_{};  // a ring
};

}  // namespace sfsm
