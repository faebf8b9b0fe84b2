// A page in a headless browser, where there is one.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "tests/report/webdriver.h"

namespace tests {

// Skips, loudly, without a browser.
class InBrowser : public testing::Test {
protected:
    void SetUp() override {
        const std::string driver = find_program({"chromedriver"});
        const std::string program = find_program({"chromium", "google-chrome"});
        if (driver.empty() || program.empty()) {
            GTEST_SKIP() << "found no " << (driver.empty() ? "chromedriver" : "chromium")
                         << " in PATH: the page is NOT tested in a browser";
        }
        browser_ = std::make_unique<Browser>(driver, program);
    }

    nlohmann::json value(const std::string& script) const { return browser_->value(script); }

    // Until the page says so: drawing waits for the browser.
    void wait_for(const std::string& script) const {
        constexpr auto patience = std::chrono::seconds(30);
        const auto deadline = std::chrono::steady_clock::now() + patience;
        while (value(script) != true) {
            ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "in vain: " << script;
        }
    }

    Directory folder_;
    std::unique_ptr<Browser> browser_;
};

}  // namespace tests
