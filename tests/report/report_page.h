// A report opened in a headless browser, as its reader moves and asks it.
#pragma once

#include <fstream>
#include <string>

#include "sfsm/report/report.h"
#include "tests/report/in_browser.h"

namespace tests {

using nlohmann::json;

class ReportPage : public InBrowser {
protected:
    void load(const sfsm::Report& report) const {
        std::ofstream file(folder_ / "a report.html", std::ios::binary);
        sfsm::write_report_html(file, report);
        file.close();
        browser_->open(address());
    }

    std::string address() const { return "file://" + (folder_ / "a%20report.html"); }

    // Where a place on the axis is in a chart, in the middle of its height [px of the window].
    json place(const std::string& chart, double at) const {
        const std::string found =
            value("const svg = document.querySelector('#" + chart +
                  " > svg'); svg.scrollIntoView({ block: 'center' });"
                  "const clip = svg.querySelector('clipPath rect').getBBox();"
                  "const box = svg.getBoundingClientRect(), scale = box.width / svg.viewBox.baseVal.width;"
                  "const from = Number(svg.dataset.from), to = Number(svg.dataset.to);"
                  "const x = clip.x + (" +
                  std::to_string(at) +
                  " - from) / (to - from) * clip.width;"
                  "return JSON.stringify({ x: Math.round(box.left + x * scale), y: Math.round(box.top + "
                  "box.height / 2) })")
                .get<std::string>();
        return json::parse(found);
    }

    static json move(const json& place, int ms = 0) {
        return {
            {"type", "pointerMove"}, {"duration", ms}, {"origin", "viewport"}, {"x", place["x"]}, {"y", place["y"]}};
    }
    static json down() { return {{"type", "pointerDown"}, {"button", 0}}; }
    static json up() { return {{"type", "pointerUp"}, {"button", 0}}; }

    void hover(const json& place) const { browser_->act("pointer", json::array({move(place)})); }

    void drag(const json& from, const json& to) const {
        browser_->act("pointer", json::array({move(from), down(), move(to, 50), up()}));
    }

    void wheel(const json& place, int delta) const {
        browser_->act("wheel", json::array({{{"type", "scroll"},
                                             {"origin", "viewport"},
                                             {"x", place["x"]},
                                             {"y", place["y"]},
                                             {"deltaX", 0},
                                             {"deltaY", delta}}}));
    }

    // A finger that goes from one place of a chart to another.
    json finger(const std::string& name, const std::string& chart, double begin, double end) const {
        return {{"type", "pointer"},
                {"id", name},
                {"parameters", {{"pointerType", "touch"}}},
                {"actions", json::array({move(place(chart, begin)), down(), move(place(chart, end), 100), up()})}};
    }

    static json stroke(const std::string& key) {
        return json::array({{{"type", "keyDown"}, {"value", key}}, {{"type", "keyUp"}, {"value", key}}});
    }

    void focus(const std::string& chart) const {
        value("document.querySelector('#" + chart + " > svg').focus({ preventScroll: true })");
    }

    void press(const std::string& chart, const std::string& key) const {
        focus(chart);
        browser_->act("key", stroke(key));
    }

    // Goes from frame to frame.
    void step(const std::string& chart, const std::string& key, int times) const {
        const std::string shift = "\uE008";
        focus(chart);
        json keys = json::array({{{"type", "keyDown"}, {"value", shift}}});
        for (int i = 0; i < times; ++i)
            for (const json& part : stroke(key)) keys.push_back(part);
        keys.push_back({{"type", "keyUp"}, {"value", shift}});
        browser_->act("key", keys);
    }

    // Of the read-out; empty where there is none.
    std::string told(std::size_t run, const std::string& key) const {
        return value("return document.querySelector('#readout tr[data-run=\"" + std::to_string(run) +
                     "\"] [data-key=" + key + "]')?.textContent ?? ''");
    }

    void emulate(const std::string& media, const std::string& scheme) const {
        const json features = json::array({{{"name", "prefers-color-scheme"}, {"value", scheme}}});
        browser_->command("Emulation.setEmulatedMedia", {{"media", media}, {"features", features}});
    }

    void emulate_phone(int width) const {
        browser_->command("Emulation.setDeviceMetricsOverride",
                          {{"width", width}, {"height", 740}, {"deviceScaleFactor", 2}, {"mobile", true}});
    }

    // What sticks out of a window of this width, if the page scrolls sideways.
    void expect_narrow(int width) const {
        EXPECT_LE(value("return document.documentElement.scrollWidth"), width) << value(
            "return [...document.querySelectorAll('body *')].filter((part) => part.getBoundingClientRect().right > " +
            std::to_string(width) + ").map((part) => part.outerHTML.slice(0, 80))");
    }
};

}  // namespace tests
