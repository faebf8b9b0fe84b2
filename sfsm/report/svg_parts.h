// What pictures are made of: text and lines as SVG, curves over axes, legends and tables.
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "sfsm/report/plot.h"

namespace sfsm::report {

// [px]
inline constexpr double picture_width = 960;
inline constexpr double chart_left = 64, chart_right = 936;
inline constexpr int chart_columns = static_cast<int>(chart_right - chart_left);

inline constexpr const char* ink = "#1c2127";
inline constexpr const char* faint_ink = "#56606c";
inline constexpr const char* grid = "#e4e7eb";

// Of eight, which come again; page/base.css has the same.
const char* colour_of(std::size_t run);

std::string text(double x, double y, const std::string& attributes, const std::string& content);
std::string line(double x1, double y1, double x2, double y2, const std::string& colour);
std::string rectangle(double x, double y, double width, double height, const std::string& fill);
std::string filled(std::string colour);  // an attribute
std::string stroke(const std::string& path, const std::string& colour, const std::string& attributes = "");

// Where frame i begins [px]; it ends where the next one begins.
using Begins = std::function<double(std::int64_t frame)>;

// From bucket to bucket, each from the end that is nearer to where the last one ended. `steps`: values hold for whole
// frames. One that stands alone becomes a short dash, or nobody would see it.
std::string curve(std::span<const Bucket> buckets, const Begins& begins, const Axis& y, bool steps);

// Small triangles at the top where a curve goes on beyond it.
std::string carets(std::span<const Bucket> buckets, const Begins& begins, const Axis& y, const std::string& colour);

// The line of a title over a chart, the grid, and the labels of the y-axis.
std::string chart_frame(const std::string& title, const Axis& y, int most_ticks);

// A line of samples with names, in as many lines as they need up to `end` [px]. Returns the last line's y.
double draw_legend(std::string& out, std::span<const std::string> names, double y, double end);

// A row for each of the names: nearest ranks of its finite times. Returns where it ends.
double draw_percentiles(std::string& out, std::span<const std::string> names, std::span<const std::vector<float>> times,
                        double top);

}  // namespace sfsm::report
