#include "tests/bench/loss/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace bench::loss {

namespace {

template <typename... Values>
std::string line(const char* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<double> ranks(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> rank(values.size());
    for (std::size_t from = 0, end = 0; from < order.size(); from = end) {
        while (end < order.size() && values[order[end]] == values[order[from]]) ++end;
        for (std::size_t i = from; i < end; ++i) rank[order[i]] = 0.5 * static_cast<double>(from + end - 1);
    }
    return rank;
}

// What is expected and measured of some pictures.
struct Pairs {
    std::vector<double> expected, measured, ratios;

    void add(const Measured::One& one, const figures::ExpectedError& error,
             const render::native::BackdropErrors& around) {
        expected.push_back(bench::loss::expected(one, error, around));
        measured.push_back(one.flip);
        ratios.push_back(expected.back() / measured.back());
    }
};

}  // namespace

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const std::vector<double> x = ranks(a), y = ranks(b);
    const double middle = 0.5 * (static_cast<double>(a.size()) - 1);
    double xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xx += (x[i] - middle) * (x[i] - middle);
        yy += (y[i] - middle) * (y[i] - middle);
        xy += (x[i] - middle) * (y[i] - middle);
    }
    return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 1;
}

std::vector<Residuals> residuals_of(const Measured& measured, const figures::ExpectedError& error,
                                    const render::native::BackdropErrors& around) {
    std::vector<Residuals> all;
    const auto& pictures = measured.all();
    for (std::size_t from = 0, end = 0; from < pictures.size(); from = end) {
        const Picture& first = *pictures[from].picture;
        Residuals& view = all.emplace_back(Residuals{first.people, first.view, first.is_fitted, 1, 1, {}, 1});
        Pairs pairs;
        for (; end < pictures.size(); ++end) {
            const Picture& picture = *pictures[end].picture;
            if (picture.people != first.people || picture.view != first.view) break;
            pairs.add(pictures[end], error, around);
            if (std::abs(std::log(pairs.ratios.back())) <= std::abs(std::log(view.worst))) continue;
            view.worst = pairs.ratios.back();
            view.worst_recipe = picture.recipe;
        }
        view.median = median(pairs.ratios);
        view.rank = rank_correlation(pairs.expected, pairs.measured);
    }
    return all;
}

std::string table_of(const std::vector<Residuals>& residuals) {
    std::string text =
        "| people | view | | expected / measured: median | worst | of | rank correlation "
        "|\n|--:|---|---|--:|--:|---|--:|\n";
    for (const Residuals& one : residuals)
        text +=
            line("| %lld | %s | %s | %.2f | %.2f | %s | %.3f |\n", static_cast<long long>(one.people), one.view.c_str(),
                 one.is_fitted ? "fitted" : "judged", one.median, one.worst, one.worst_recipe.c_str(), one.rank);
    return text;
}

std::string summary_of(const Measured& measured, const figures::ExpectedError& error,
                       const render::native::BackdropErrors& around) {
    std::string text;
    for (const bool is_fitted : {true, false}) {
        Pairs pairs;
        for (const Measured::One& one : measured.all())
            if (one.picture->is_fitted == is_fitted) pairs.add(one, error, around);
        if (pairs.ratios.empty()) continue;
        std::vector<double> off;
        for (const double ratio : pairs.ratios) off.push_back(std::abs(std::log(ratio)));
        const auto within = std::ranges::count_if(off, [](double one) { return one <= std::log(1.15); });
        text += line(
            "%s: %zu pictures, off by %.1f %% in the median, %.1f %% at most, %.0f %% of them within 15 %%; "
            "rank correlation %.3f\n",
            is_fitted ? "fitted" : "judged", off.size(), 100 * std::expm1(median(off)),
            100 * std::expm1(*std::ranges::max_element(off)),
            100.0 * static_cast<double>(within) / static_cast<double>(off.size()),
            rank_correlation(pairs.expected, pairs.measured));
    }
    return text;
}

std::string text_of(const figures::ExpectedError& e) {
    return line(".error = {.finest = %.4g, .growth = %.4g, .power = %.4g, .blur = %.4g,\n", e.finest, e.growth, e.power,
                e.blur) +
           line("          .hole = %.4g, .filling = %.4g, .mesh = %.4g, .mesh_height = %.4g, .mesh_power = %.4g,\n",
                e.hole, e.filling, e.mesh, e.mesh_height, e.mesh_power) +
           line("          .splat = %.4g, .splat_growth = %.4g, .splat_blur = %.4g, .splat_most = %.4g,\n", e.splat,
                e.splat_growth, e.splat_blur, e.splat_most) +
           line("          .motion_growth = %.4g, .motion_most = %.4g}\n", e.motion_growth, e.motion_most);
}

std::string text_of(const render::native::BackdropErrors& e) {
    return line("float all = %.4gf, ground = %.4gf, unrest = %.4gf;\n", static_cast<double>(e.all),
                static_cast<double>(e.ground), static_cast<double>(e.unrest));
}

}  // namespace bench::loss
