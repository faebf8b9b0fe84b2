#include "tests/bench/front/page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "sfsm/controller.h"
#include "tests/bench/front/chart.h"
#include "tests/bench/front/made_up.h"
#include "tests/bench/front/sentences.h"
#include "tests/report/sample.h"

namespace {

using namespace bench::front;
using nlohmann::json;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const ErrorKind& kind(std::string_view id) {
    for (const ErrorKind& error : error_kinds())
        if (error.id == id) return error;
    throw std::out_of_range("no error is called " + std::string(id));
}

// A setting of 20,000 people, still.
Row setting(const std::string& name, double ms, double flip, double psnr = 40) {
    Row row;
    row.people = 20'000;
    row.view = "still";
    row.is_preset = true;
    row.family = "native points";
    row.setting = name;
    row.wall_ms = row.wall_low_ms = row.wall_high_ms = ms;
    row.frame.flip = flip;
    row.frame.psnr = psnr;
    return row;
}

Row mark(double target_ms, double ms, double flip, double psnr = 40) {
    Row row = setting("S = 9", ms, flip, psnr);
    row.law = sfsm::law_names().front();
    row.target_ms = target_ms;
    return row;
}

Scene scene_of_rows(const std::vector<Row>& rows) {
    Scene scene{20'000, "still", true, rows, {}};
    for (std::size_t i = 0; i < rows.size(); ++i) scene.places.push_back(i);
    return scene;
}

// With plain blanks.
std::string plain(std::string text) {
    const std::string blank = "\u00A0";
    for (std::size_t at; (at = text.find(blank)) != text.npos;) text.replace(at, blank.size(), " ");
    return text;
}

std::string draw(const std::vector<Row>& rows, std::string_view error = "flip") {
    return plain(what_to_draw(scene_of_rows(rows), kind(error)).text());
}
std::string buys(const std::vector<Row>& rows, std::string_view error = "flip") {
    return plain(what_a_millisecond_buys(scene_of_rows(rows), kind(error)).text());
}
std::string loses(const std::vector<Row>& rows, std::string_view error = "flip") {
    return plain(where_the_law_loses({scene_of_rows(rows)}, kind(error)).sentence.text());
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++found;
    return found;
}

json data_of(const std::string& html) {
    const std::string begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t from = html.find(begin) + begin.size();
    return json::parse(html.substr(from, html.find("</script>", from) - from));
}

// By asking each of each, which front_of doesn't.
std::set<std::size_t> unbeaten(const std::vector<Row>& rows, const ErrorKind& error) {
    const auto takes_part = [&](const Row& row) {
        return row.law.empty() && row.wall_ms > 0 && row.wall_ms < infinity && !std::isnan(error.value(row));
    };
    const auto beats = [&](const Row& a, const Row& b) {
        const double sign = error.more_is_better ? -1 : 1;
        const double va = sign * error.value(a), vb = sign * error.value(b);
        return takes_part(a) && a.wall_ms <= b.wall_ms && va <= vb && (a.wall_ms < b.wall_ms || va < vb);
    };
    std::set<std::size_t> found;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        bool is_beaten = !takes_part(rows[i]);
        for (const Row& other : rows) is_beaten = is_beaten || beats(other, rows[i]);
        if (!is_beaten) found.insert(i);
    }
    return found;
}

// Few different values, so that ties and equal rows are common.
Row random_row(std::mt19937& bits) {
    const auto of = [&](unsigned long most) { return static_cast<double>(bits() % most); };
    Row row = setting("", of(8), of(6) / 10, of(5) * 10);
    const unsigned long odd = bits() % 24;
    if (odd == 0) row.frame.flip = row.frame.psnr = nan;
    if (odd == 1) row.frame.psnr = infinity;
    if (odd == 2) row.wall_ms = nan;
    if (odd == 3) row.wall_ms = infinity;
    if (odd < 6 && odd > 3) row.law = "paper";
    return row;
}

TEST(FrontOf, IsWhatNoOtherBeats) {
    std::mt19937 bits(7);
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<Row> rows(bits() % 14);
        for (Row& row : rows) row = random_row(bits);
        for (const char* id : {"flip", "psnr"}) {
            const std::vector<std::size_t> front = front_of(rows, kind(id));
            ASSERT_EQ(std::set<std::size_t>(front.begin(), front.end()), unbeaten(rows, kind(id))) << id << trial;
            ASSERT_EQ(front.size(), unbeaten(rows, kind(id)).size()) << "each once";
            for (std::size_t i = 1; i < front.size(); ++i)
                ASSERT_LE(rows[front[i - 1]].wall_ms, rows[front[i]].wall_ms) << "from fast to slow";
        }
    }
}

TEST(FrontOf, TheSamePictureIsTheBestPsnr) {
    const std::vector<Row> rows = {setting("a", 5, 0.1, 30), setting("b", 9, 0, infinity), setting("c", 12, 0, 60)};
    EXPECT_EQ(front_of(rows, kind("psnr")), (std::vector<std::size_t>{0, 1}));
}

TEST(Scenes, TwentyThousandComeFirstAndPresetsBeforeMoments) {
    std::vector<std::string> names;
    Front front;
    for (const auto& [people, view] : std::vector<std::pair<int, std::string>>{{1'000, "roam-4s"},
                                                                               {1'000, "still"},
                                                                               {1'000'000, "still"},
                                                                               {20'000, "roam-4s"},
                                                                               {20'000, "wide"},
                                                                               {20'000, "close"},
                                                                               {20'000, "wide"}}) {
        Row row = setting("", 1, 1);
        row.people = people;
        row.view = view;
        row.is_preset = !view.starts_with("roam");
        front.rows.push_back(row);
    }
    const std::vector<Scene> scenes = scenes_of(front);
    for (const Scene& scene : scenes) names.push_back(scene.name());
    EXPECT_EQ(names,
              (std::vector<std::string>{"20,000 people, wide", "20,000 people, close", "20,000 people, roam-4s",
                                        "1,000 people, still", "1,000 people, roam-4s", "1,000,000 people, still"}));
    EXPECT_EQ(scenes[0].places, (std::vector<std::size_t>{4, 6}));
}

TEST(Sentences, NameTheBestThatAFrameHasTimeFor) {
    EXPECT_EQ(draw({setting("S = 4", 5, 0.1), setting("S = 1", 16.6, 0.02), setting("S = 0.5", 16.7, 0.01)}),
              "For 20,000 people, still, native points, S = 1: 16.6 ms, FLIP 0.0200.");
    EXPECT_EQ(draw({setting("S = 4", 22, 0.1), setting("S = 1", 1600, 0.02)}),
              "Of 20,000 people, still, nothing is so fast; native points, S = 4 comes nearest: 22.0 ms, FLIP 0.1000.");
    EXPECT_EQ(draw({setting("S = 4", 5, 0.1, infinity)}, "psnr"),
              "For 20,000 people, still, native points, S = 4: 5.00 ms, PSNR \u221E dB.");
    const std::string none = "Not known: of 20,000 people, still, no setting was measured.";
    EXPECT_EQ(draw({}), none);
    EXPECT_EQ(draw({mark(16.6, 10, 0.1)}), none);
    EXPECT_EQ(draw({setting("", nan, 0.1), setting("", 5, nan)}), none);
}

TEST(Sentences, TellWhatAMillisecondBuysAroundAFrame) {
    const Row fast = setting("S = 4", 10, 0.1, 30), middle = setting("S = 2", 20, 0.09, 34),
              late = setting("S = 1", 30, 0.02, 36), far = setting("S = 0.5", 400, 0.01, infinity);
    EXPECT_EQ(buys({fast, middle, late, far}),
              "0.0040 less FLIP, 4.0 % of it, on the way from 10.0 to 30.0 ms. The next step is native points, S = 2: "
              "20.0 ms, FLIP 0.0900.");
    EXPECT_EQ(buys({fast, late}, "psnr"),
              "0.30 dB more PSNR on the way from 10.0 to 30.0 ms. The next step is native points, S = 1: 30.0 ms, PSNR "
              "36.00 dB.");
    EXPECT_EQ(buys({fast, far}),
              "Nothing yet. The next better setting is native points, S = 0.5: 400 ms, FLIP 0.0100.");
    EXPECT_EQ(buys({fast}), "Nothing: no setting has a better FLIP, however slow.");
    EXPECT_EQ(
        buys({setting("S = 1", 100, 0.04), setting("S = 0.5", 180, 0.016)}),
        "0.00030 less FLIP, 0.75 % of it, on the way from 100 to 180 ms. The next step is native points, S = 0.5: "
        "180 ms, FLIP 0.0160.")
        << "where nothing is fast enough, from the fastest";
    EXPECT_EQ(buys({fast, setting("exact", 25, 0, infinity)}, "psnr"),
              "The exact picture, by native points, exact: 25.0 ms, PSNR \u221E dB.");
    EXPECT_EQ(buys({}), "Not known: no setting was measured.");
}

TEST(Sentences, NameWhereTheLawLosesMost) {
    const Row best = setting("S = 1", 10, 0.02, 40);
    Row other = mark(16.6, 12, 0.9, 10);
    other.law = "paper";
    const std::vector<Row> rows = {best, mark(16.6, 12, 0.03, 39), mark(33, 30, 0.05, 31), mark(8, 9, 0.9), other};
    EXPECT_EQ(
        loses(rows),
        "With 20,000 people, still, at a target of 33 ms, predictive has 2.5 times the FLIP of the front: 0.0500 in "
        "30.0 ms; native points, S = 1 has 0.0200 in 10.0 ms.");
    EXPECT_EQ(
        loses(rows, "psnr"),
        "With 20,000 people, still, at a target of 33 ms, predictive has 9.0 dB less PSNR than the front: 31.00 in "
        "30.0 ms; native points, S = 1 has 40.00 in 10.0 ms.");
    const Loss loss = where_the_law_loses({scene_of_rows({}), scene_of_rows(rows)}, kind("flip"));
    EXPECT_EQ(loss.scene, 1U);
    EXPECT_EQ(loss.row, 2U);
    EXPECT_EQ(loses({best, mark(16.6, 12, 0.0201), mark(33, 30, 0.01)}),
              "Nowhere: all 2 choices of predictive are on the front or beyond.");
    EXPECT_EQ(loses({best, mark(8, 9, 0.9)}), "Not known: no setting was as fast as what predictive chose.");
    EXPECT_EQ(loses({best, other}), "Not known: what predictive chooses was not measured.");
    EXPECT_EQ(loses({}), "Not known: what predictive chooses was not measured.");
}

TEST(Sentences, AnErrorWhereNoneIsNeededIsTheWorst) {
    const std::vector<Row> rows = {setting("a", 5, 0, infinity), mark(8, 6, 0.001, 50), mark(33, 30, 0.5, infinity)};
    EXPECT_NE(loses(rows).find("an error where none is needed"), std::string::npos);
    EXPECT_NE(loses(rows, "psnr").find("at a target of 8 ms"), std::string::npos);
    EXPECT_EQ(loses({setting("a", 5, 0, infinity), mark(33, 30, 0, infinity)}).substr(0, 7), "Nowhere");
    EXPECT_EQ(loses({setting("a", 5, 0, infinity), mark(33, 30, 0, infinity)}, "psnr").substr(0, 7), "Nowhere");
}

// One setting of each odd kind.
Front odd_front() {
    Front front{{tests::hostile, 1, tests::hostile, tests::hostile}, {}};
    front.rows = {setting("zero", 5, 0, infinity),
                  setting("huge", 1e12, 1e30, -1e30),
                  setting("none", nan, 0.1),
                  setting("unknown", 6, nan, nan),
                  setting("negative", -1, -1),
                  mark(16.6, 12, 0.1),
                  mark(nan, 13, 0.2)};
    front.rows[1].work[sfsm::WorkKind::point] = std::numeric_limits<std::int64_t>::max();
    front.rows.push_back(front.rows[0]);
    Row& hostile = front.rows.back();
    hostile.view = hostile.family = hostile.setting = tests::hostile;
    front.rows.push_back(hostile);
    front.rows.back().law = tests::hostile;
    return front;
}

const std::string png = "\x89PNG\r\n\x1A\nrest";

// Void elements of HTML aren't closed; all others must nest. Scripts, styles and the doctype aside.
void expect_nested(const std::string& html) {
    const std::set<std::string> voids = {"meta", "link", "!DOCTYPE", "br", "img"};
    std::vector<std::string> open;
    for (std::size_t at = 0; (at = html.find('<', at)) != html.npos;) {
        const std::size_t end = html.find('>', at);
        ASSERT_NE(end, html.npos);
        const std::string tag = html.substr(at + 1, end - at - 1);
        const std::string name = tag.substr(0, tag.find_first_of(" \n"));
        at = end;
        if (name[0] == '/') {
            ASSERT_FALSE(open.empty()) << tag;
            ASSERT_EQ(open.back(), name.substr(1)) << html.substr(end - 60, 80);
            open.pop_back();
        } else if (tag.back() != '/' && !voids.contains(name)) {
            ASSERT_EQ(count(tag, "\"") % 2, 0U) << tag;
            open.push_back(name);
            if (name == "script" || name == "style") at = html.find("</" + name, end) - 1;
        }
    }
    EXPECT_TRUE(open.empty()) << open.back() << " is not closed";
}

TEST(FrontPage, EveryRowHasItsPoint) {
    const Front front = made_up_front();
    const std::string html = page_of(front, {});
    const json data = data_of(html);
    std::set<std::size_t> embedded;
    for (const json& scene : data["scenes"])
        for (const json& row : scene["rows"]) embedded.insert(row[0].get<std::size_t>());
    EXPECT_EQ(embedded.size(), front.rows.size());
    for (std::size_t i = 0; i < front.rows.size(); ++i)
        ASSERT_NE(html.find("data-row=\"" + std::to_string(i) + "\""), html.npos) << "row " << i << " without a script";
}

TEST(Chart, WhatIsExactLiesBelowAllElseAndIsNamed) {
    const Scene scene =
        scene_of_rows({setting("a", 5, 0.1, 30), setting("b", 9, 0.001, 60), setting("c", 12, 0, infinity)});
    const auto height = [](const std::string& svg, int row) {
        const std::size_t at = svg.find("data-row=\"" + std::to_string(row) + "\"");
        return std::stod(svg.substr(svg.find("cy=\"", at) + 4));
    };
    for (const char* id : {"flip", "psnr"}) {
        const Range range = range_of(std::span(&scene, 1), kind(id));
        const std::string svg = chart_svg(scene, kind(id), range, {"native points"}, ChartSize::large);
        EXPECT_LT(height(svg, 0), height(svg, 1)) << id << ": down is better";
        EXPECT_LT(height(svg, 1) + 10, height(svg, 2)) << id;
        EXPECT_NE(svg.find(">exact<"), svg.npos) << id;
    }
}

TEST(Chart, EqualRatiosAreEquallyHigh) {
    EXPECT_NEAR(kind("flip").height(setting("", 1, 0.2)) - kind("flip").height(setting("", 1, 0.1)), std::log10(2),
                1e-12);
    EXPECT_EQ(kind("flip").height(setting("", 1, 0)), -infinity);
    EXPECT_EQ(kind("psnr").height(setting("", 1, 0, 30)), -30);
    EXPECT_TRUE(std::isnan(kind("flip").height(setting("", 1, nan))));
}

TEST(Chart, LawsHaveShapesOfTheirOwn) {
    std::set<std::string> shapes;
    for (const std::string_view law : sfsm::law_names()) shapes.insert(mark_path(law, 6));
    shapes.insert(mark_path("another", 6));
    EXPECT_EQ(shapes.size(), sfsm::law_names().size() + 1);
}

TEST(FrontPage, RowsAreEmbeddedAsTheyAre) {
    const Front front = made_up_front();
    const json data = data_of(page_of(front, {}));
    for (const json& scene : data["scenes"]) {
        for (const json& told : scene["rows"]) {
            const Row& row = front.rows[told[0].get<std::size_t>()];
            EXPECT_EQ(scene["people"], row.people);
            EXPECT_EQ(scene["view"], row.view);
            EXPECT_EQ(told[2], row.family);
            EXPECT_EQ(told[3], row.setting);
            EXPECT_EQ(told[4], row.law);
            EXPECT_NEAR(told[6].get<double>(), row.wall_ms, 0.00051);
            EXPECT_NEAR(told[10][0].get<double>(), row.frame.flip, 0.0000051);
            EXPECT_NEAR(told[10][2].get<double>(), 1 - row.frame.ssim, 0.0000051);
            EXPECT_EQ(told[11][0], row.work[sfsm::WorkKind::person]);
        }
    }
    EXPECT_EQ(data["scenes"][0]["name"], "20,000 people, still");
}

TEST(FrontPage, NoTextBreaksOut) {
    const std::string html = page_of(odd_front(), {});
    Front harmless = odd_front();
    harmless.machine = {"x", 1, "x", "x"};
    for (Row& row : harmless.rows)
        for (std::string* text : {&row.view, &row.family, &row.setting, &row.law})
            if (*text == tests::hostile) *text = "x";
    const std::string harmless_html = page_of(harmless, {});
    for (const char* tag : {"<script", "</script", "</title", "<img", "id=\"data\"", "{{"})
        EXPECT_EQ(count(html, tag),
                  count(harmless_html, tag) + (tag == std::string("{{") ? count(html, "{{data}}") : 0))
            << tag;
    EXPECT_EQ(html.find('\x01'), html.npos);
    EXPECT_EQ(html.find('\xFF'), html.npos);
    EXPECT_FALSE(data_of(html)["scenes"].empty());
}

TEST(FrontPage, NeedsNothingElse) {
    const Front front = made_up_front();
    const std::string html = page_of(front, made_up_crops(front));
    EXPECT_EQ(count(html, "http"), 1U) << "the header that forbids resources";
    EXPECT_EQ(count(html, "http-equiv"), 1U);
    EXPECT_EQ(count(html, "src="), 0U);
    EXPECT_EQ(html.find("@import"), html.npos);
    EXPECT_EQ(html.find("url("), html.npos);
    EXPECT_EQ(count(html, "href="), 1U);
    EXPECT_EQ(count(html, "href=\"data:,\""), 1U);
}

TEST(FrontPage, IsWellFormedWhateverTheNumbers) {
    Front one{{}, {setting("S = 1", 10, 0.02)}};
    for (const Front& front : {Front{}, one, odd_front(), made_up_front()}) {
        SCOPED_TRACE(std::to_string(front.rows.size()) + " rows");
        const std::string html = page_of(front, {});
        expect_nested(html);
        for (const char* bad : {"\"NaN\" ", "=\"nan", "=\"-nan", "=\"inf", "\u221E \u221E", " nan", "(nan"})
            EXPECT_EQ(html.find(bad), html.npos) << bad;
        for (std::size_t at = 0; (at = html.find(" d=\"", at)) != html.npos; ++at) {
            const std::string d = html.substr(at + 4, html.find('"', at + 4) - at - 4);
            ASSERT_EQ(d.find_first_not_of("MLHVZmlhvz-. 0123456789"), d.npos) << d;
        }
    }
}

TEST(FrontPage, StaysSmall) {
    const Front front = made_up_front();
    const std::string html = page_of(front, {});
    EXPECT_GT(front.rows.size(), 1000U);
    EXPECT_LT(html.size(), 100'000 + 1024 * front.rows.size());
    const Crops crops{{{0, png + std::string(30'000, 'x')}}, {}};
    EXPECT_LT(page_of(front, crops).size(), html.size() + 41'000);
}

TEST(FrontPage, CropsStandByTheirRows) {
    const Front front{{}, {setting("S = 1", 10, 0.02), setting("S = 2", 5, 0.04)}};
    const Crops crops{{{1, png}, {0, "\xFF\xD8\xFF..."}}, {{{20'000, "still"}, png}, {{5, "still"}, png}}};
    const json data = data_of(page_of(front, crops));
    EXPECT_EQ(data["crops"]["1"], "data:image/png;base64,iVBORw0KGgpyZXN0");
    EXPECT_EQ(data["crops"]["0"], "data:image/jpeg;base64,/9j/Li4u");
    EXPECT_EQ(data["references"], json::array({"data:image/png;base64,iVBORw0KGgpyZXN0"}));
}

TEST(FrontPage, CropsThatCannotBeShownAreRefused) {
    const Front front{{}, {setting("S = 1", 10, 0.02)}};
    const auto message = [&](const Crops& crops) -> std::string {
        try {
            page_of(front, crops);
            return "";
        } catch (const std::runtime_error& error) {
            return error.what();
        }
    };
    EXPECT_EQ(message({{{1, png}}, {}}), "found a crop of row 1, expected one of the 1 rows of the front");
    EXPECT_EQ(message({{{0, "GIF89a"}}, {}}),
              "the crop of row 0: found 6 bytes of something else, expected a PNG or JPEG");
    EXPECT_EQ(
        message({{}, {{{20'000, "still"}, ""}}}),
        "the crop of 20,000 people, still, the reference: found 0 bytes of something else, expected a PNG or JPEG");
}

TEST(FrontPage, SameFrontGivesTheSameBytes) {
    const Front front = made_up_front();
    EXPECT_EQ(page_of(front, made_up_crops(front)), page_of(made_up_front(), made_up_crops(front)));
}

}  // namespace
