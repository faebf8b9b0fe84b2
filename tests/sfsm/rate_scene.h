// A view whose people are of a few classes, each with an error that is a power of the points a person gets: what a rate
// draws, and the least that can be lost in a time, are known in closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "sfsm/forecast.h"
#include "sfsm/prices.h"
#include "tests/sfsm/simulation.h"

namespace sfsm {

struct PersonClass {
    double people;
    double error;  // of a person drawn by one point [FLIP of the frame]; with w points error / w
};

struct RateScene {
    static constexpr double mesh_points = 700;  // from so many on a person is drawn by triangles, and loses nothing
    static constexpr double mesh_triangles = 1000;
    static constexpr double still = 0.1;  // of a class' error at one point, that somebody loses who moves half as often
    static constexpr double least_moving = 1.0 / 16;
    static constexpr double least_rate = 1e-12, octaves = 28;

    std::vector<PersonClass> classes;
    Prices prices;
    std::vector<RateStep> rates;
    std::vector<Step> motion, shapes;
    Forecast forecast;

    // error / w falls by error / w^2 a point: the next one saves less than the rate.
    static double points_each(const PersonClass& people, double rate) {
        return std::max(1.0, std::sqrt(people.error / rate));
    }
    // Of those who move in each frame: still * error * (1 / u - 1) is lost.
    static double moving(const PersonClass& people, double rate) {
        return std::clamp(std::sqrt(still * people.error / rate), least_moving, 1.0);
    }

    RateStep at(double rate) const {
        RateStep step;
        step.rate = rate;
        double triangles = 0, points = 0, updates = 0, seen = 0, slowed = 0;
        for (const PersonClass& people : classes) {
            const double each = points_each(people, rate), share = moving(people, rate);
            const bool has_points = each < mesh_points;
            points += has_points ? people.people * each : 0;
            triangles += has_points ? 0 : people.people * mesh_triangles;
            updates += people.people * share;
            seen += people.people;
            slowed += share < 1 ? people.people : 0;
            step.loss += people.people * people.error * ((has_points ? 1 / each : 0) + still * (1 / share - 1));
        }
        step.state = points > 0 ? State::points : slowed > 0 ? State::slowed : State::original;
        step.motion_distance =
            slowed > 0 ? test_range * std::max(0.01, 1 - slowed / seen) : std::numeric_limits<double>::infinity();
        step.splat_size = points > 0 ? std::min(max_splat_size, 500 * seen / points) : 0;
        step.work[WorkKind::triangle] = std::llround(triangles);
        step.work[WorkKind::point] = std::llround(points);
        step.work[WorkKind::motion_update] = std::llround(updates);
        step.work[WorkKind::single] = std::llround(seen);
        return step;
    }

    // What a renderer draws for a decision by rate.
    Work work(const Decision& decision) const {
        Work work = at(decision.rate).work;
        work += forecast.frame;
        return work;
    }
    double ms(const Work& work) const { return cost_of(work, prices); }

    double ms(const RateStep& step) const {
        return cost_of(step.work, prices) + cost_of(forecast.frame, {0, prices.each});
    }

    // The least that is lost in a time: of so many rates that no other is near.
    double least_loss(double budget_ms) const {
        for (double rate = least_rate; rate < least_rate * std::exp2(octaves); rate *= 1.002) {
            Decision decision;
            decision.rate = rate;
            if (ms(work(decision)) <= budget_ms) return at(rate).loss;
        }
        return at(least_rate * std::exp2(octaves)).loss;
    }

    RateScene(std::vector<PersonClass> some, const Prices& of_each) : classes(std::move(some)), prices(of_each) {
        double seen = 0;
        for (const PersonClass& people : classes) seen += people.people;
        for (int i = 0; i <= octaves; ++i) rates.push_back(at(least_rate * std::exp2(i)));
        add_pairs(seen);
        Work frame;
        frame[WorkKind::person] = std::llround(seen);
        forecast = {frame, motion, shapes, rates};
    }
    RateScene(const RateScene& other) : RateScene(other.classes, other.prices) {}

private:
    // The same people, all alike.
    void add_pairs(double seen) {
        for (int i = 0; i < 7; ++i) {
            const double distance = i == 0 ? std::numeric_limits<double>::infinity() : test_range * (1 - i / 6.5);
            Step step{distance, {}, 0.1 * i};
            step.work[WorkKind::motion_update] = std::llround(seen * (1 - i / 7.0));
            motion.push_back(step);
        }
        for (int i = 0; i <= 28; ++i) {
            Step step{i == 0 ? 0 : 0.25 * std::exp2(i / 4.0), {}, 0};
            if (i == 0) step.work[WorkKind::triangle] = std::llround(seen * mesh_triangles);
            if (i > 0) step.work[WorkKind::point] = std::llround(seen * std::max(1.0, 500 / step.setting));
            step.work[WorkKind::single] = std::llround(seen);
            step.loss_px = 0.5 * step.setting;
            shapes.push_back(step);
        }
    }
};

// Prices of a desktop: the whole of 20,000 people takes some 25 ms, the least of it some 6.
inline constexpr Prices desktop_prices{2, {2e-5, 1e-6, 4e-7, 1e-4, 0, 0, 1e-4}};

// From the near few to the far many, who have a hundredth of the others' error.
inline RateScene bowl(double people = 20'000, const Prices& prices = desktop_prices) {
    constexpr int count = 600;
    std::vector<PersonClass> classes;
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const double error = std::exp2(-i / 90.0);
        classes.push_back({std::pow(error, -0.7), 2e-4 * error});
        sum += classes.back().people;
    }
    for (PersonClass& each : classes) each.people *= people / sum;
    return {classes, prices};
}

}  // namespace sfsm
