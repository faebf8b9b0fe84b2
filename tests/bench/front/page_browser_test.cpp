// The page as a reader has it: in a headless browser, opened as a file, with a mouse, fingers and keys.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <utility>

#include "tests/bench/front/made_up.h"
#include "tests/bench/front/page.h"
#include "tests/report/in_browser.h"

namespace {

using nlohmann::json;

class FrontInBrowser : public tests::InBrowser {
protected:
    void SetUp() override {
        InBrowser::SetUp();
        if (!IsSkipped()) open(front_, bench::front::made_up_crops(front_));
    }

    void open(const bench::front::Front& front, const bench::front::Crops& crops) {
        std::ofstream(folder_ / "front.html", std::ios::binary) << bench::front::page_of(front, crops);
        browser_->open("file://" + (folder_ / "front.html"));
    }

    void press(const std::string& key) const {
        value("document.querySelector('#chart > svg').focus({ preventScroll: true })");
        browser_->act("key", json::array({{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}}));
    }

    // The row that the panel tells of.
    std::size_t shown() const {
        return std::stoul(value("return document.querySelector('#panel').dataset.row").get<std::string>());
    }

    // Where a row's point is in the large chart [px of the window].
    json place(std::size_t row) const {
        return json::parse(value("const point = document.querySelector('#chart [data-row=\"" + std::to_string(row) +
                                 "\"]'); point.scrollIntoView({ block: 'center' });"
                                 "const box = point.getBoundingClientRect(); return JSON.stringify({ x: Math.round("
                                 "box.left + box.width / 2), y: Math.round(box.top + box.height / 2) })")
                               .get<std::string>());
    }

    // A point that no other is near to.
    std::size_t lonely_row() const {
        for (std::size_t i = 0; i < front_.rows.size(); ++i) {
            const bench::front::Row& row = front_.rows[i];
            if (row.people == 20'000 && row.view == "still" && row.family == "OpenGL triangles") return i;
        }
        throw std::logic_error("no triangles by OpenGL");
    }

    bench::front::Front front_ = bench::front::made_up_front();
};

TEST_F(FrontInBrowser, ConsoleStaysSilent) {
    EXPECT_EQ(browser_->console(), json::array());
    bench::front::Front odd;
    open(odd, {});
    EXPECT_EQ(browser_->console(), json::array()) << "of nothing";
    odd.rows.push_back(front_.rows[0]);
    odd.rows[0].wall_ms = std::numeric_limits<double>::quiet_NaN();
    open(odd, {});
    for (const char* error : {"psnr", "motion", "flip"})
        value("document.querySelector('[data-error=" + std::string(error) + "]').click()");
    EXPECT_EQ(browser_->console(), json::array()) << "of a row without a time";
}

// Where a row's point is in the first chart of the page's text that has it, as the program wrote it.
std::pair<double, double> written_place(const std::string& html, std::size_t row) {
    const std::size_t at = html.find("data-row=\"" + std::to_string(row) + "\"");
    const std::string tag = html.substr(at, html.find("/>", at) - at);
    const auto number_after = [&](const std::string& text) {
        const std::size_t found = tag.find(text);
        return found == tag.npos ? std::nan("") : std::stod(tag.substr(found + text.size()));
    };
    const std::size_t translate = tag.find("translate(");
    if (translate == tag.npos) return {number_after("cx=\""), number_after("cy=\"")};
    const std::size_t blank = tag.find(' ', translate);
    return {number_after("translate("), std::stod(tag.substr(blank))};
}

TEST_F(FrontInBrowser, ScriptDrawsWhereTheProgramDrew) {
    const std::string html = bench::front::page_of(front_, {});
    const json drawn = value(
        "return [...document.querySelectorAll('.view [data-row]')].map((point) => { const at = "
        "point.transform.baseVal[0]?.matrix; return [Number(point.dataset.row), at?.e ?? point.cx.baseVal.value, "
        "at?.f ?? point.cy.baseVal.value]; })");
    ASSERT_EQ(drawn.size(), front_.rows.size());
    constexpr double nearly = 0.1;  // [px]; the script has errors with five digits
    for (const json& point : drawn) {
        const auto [x, y] = written_place(html, point[0]);
        ASSERT_NEAR(point[1].get<double>(), x, nearly) << "row " << point[0];
        ASSERT_NEAR(point[2].get<double>(), y, nearly) << "row " << point[0];
    }
}

TEST_F(FrontInBrowser, PointingShowsTheSetting) {
    const std::size_t first = shown(), row = lonely_row();
    ASSERT_NE(first, row);
    browser_->act("pointer", json::array({{{"type", "pointerMove"},
                                           {"duration", 0},
                                           {"origin", "viewport"},
                                           {"x", place(row)["x"]},
                                           {"y", place(row)["y"]}}}));
    wait_for("return document.querySelector('#panel').dataset.row == " + std::to_string(row));
    const std::string told = value("return document.querySelector('#panel').textContent");
    EXPECT_NE(told.find("OpenGL triangles, 1 sample"), told.npos) << told;
    EXPECT_EQ(value("return document.querySelectorAll('#panel img').length"), 2) << "its crop and the reference's";
    wait_for("return [...document.querySelectorAll('#panel img')].every((image) => image.naturalWidth == 120)");
    browser_->act(
        "pointer",
        json::array({{{"type", "pointerMove"}, {"duration", 0}, {"origin", "viewport"}, {"x", 2}, {"y", 2}}}));
    wait_for("return document.querySelector('#panel').dataset.row == " + std::to_string(first));
}

TEST_F(FrontInBrowser, KeysStepThroughAllPointsByTime) {
    const std::string home = "\uE011", right = "\uE014";
    press(home);
    std::set<std::size_t> seen = {shown()};
    double last = front_.rows[shown()].wall_ms;
    const std::size_t all = value("return document.querySelectorAll('#chart [data-row]').length");
    for (std::size_t i = 1; i < all; ++i) {
        press(right);
        ASSERT_GE(front_.rows[shown()].wall_ms, last);
        last = front_.rows[shown()].wall_ms;
        seen.insert(shown());
    }
    EXPECT_EQ(seen.size(), all);
    EXPECT_NE(value("return document.querySelector('#spoken').textContent"), "");
}

TEST_F(FrontInBrowser, ChoicesChangeSentencesChartAndTable) {
    const auto told = [&] {
        return value(
            "return ['#draw', '#buys', '#scene', '#table', '#meaning'].map((part) => "
            "document.querySelector(part).textContent)");
    };
    const json first = told();
    value("document.querySelector('[data-error=psnr]').click()");
    const json psnr = told();
    value("document.querySelector('#crowds [data-people=\"1000000\"]').click()");
    const json million = told();
    value("document.querySelectorAll('.crowd:not([hidden]) .view')[1].click()");
    const json close = told();
    EXPECT_EQ(psnr[2], first[2]);
    for (const std::size_t part : {0, 1, 4}) EXPECT_NE(psnr[part], first[part]);
    EXPECT_EQ(million[2], "1,000,000 people, still") << "the same view";
    EXPECT_EQ(close[2], "1,000,000 people, close");
    for (const std::size_t part : {0, 3}) EXPECT_NE(close[part], million[part]);
    EXPECT_EQ(value("return document.querySelectorAll('.crowd:not([hidden])').length"), 1);
    value("document.querySelector('#loses button').click()");
    EXPECT_EQ(front_.rows[shown()].law, "predictive");
    EXPECT_EQ(browser_->console(), json::array());
}

TEST_F(FrontInBrowser, FitsAPhone) {
    browser_->command("Emulation.setDeviceMetricsOverride",
                      {{"width", 390}, {"height", 844}, {"deviceScaleFactor", 2}, {"mobile", true}});
    wait_for("return document.querySelector('#chart > svg').viewBox.baseVal.width < 390");
    EXPECT_LE(value("return document.documentElement.scrollWidth"), 390);
}

TEST_F(FrontInBrowser, DarkSchemeAndPaperDiffer) {
    const std::string ground = "return getComputedStyle(document.body).backgroundColor";
    const auto emulate = [&](const std::string& media, const std::string& scheme) {
        const json features = json::array({{{"name", "prefers-color-scheme"}, {"value", scheme}}});
        browser_->command("Emulation.setEmulatedMedia", {{"media", media}, {"features", features}});
    };
    emulate("", "light");
    const json light = value(ground);
    emulate("", "dark");
    EXPECT_NE(value(ground), light);
    emulate("print", "dark");
    EXPECT_EQ(value(ground), "rgb(255, 255, 255)");
    EXPECT_EQ(value("return [...document.querySelectorAll('.control')].every((part) => part.offsetParent === null)"),
              true);
}

}  // namespace
