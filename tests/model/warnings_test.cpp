#include "model/warnings.h"

#include <gtest/gtest.h>

#include <vector>

namespace model {
namespace {

std::vector<std::string> texts(const Warnings& warnings) {
    std::vector<std::string> out;
    for (const Warning& warning : warnings) out.push_back(text_of(warning));
    return out;
}

TEST(Warnings, AreOneAKindCountedWithTheFirstNamed) {
    Warnings warnings;
    EXPECT_TRUE(warnings.empty());
    warnings.add("texture not found, left out", "gone.png");
    warnings.add("normal not finite, computed", "");
    warnings.add("texture not found, left out", "lost.png");
    warnings.add("texture not found, left out", "third.png");
    EXPECT_EQ(texts(warnings), (std::vector<std::string>{"texture not found, left out: 'gone.png', and 2 more",
                                                         "normal not finite, computed"}));
}

TEST(Warnings, AreOneShortPrintableLine) {
    Warnings warnings;
    warnings.add("extension unknown, left out", "a\nb\x1b" + std::string(400'000, 'x'));
    const std::string text = text_of(*warnings.begin());
    EXPECT_LT(text.size(), 200u);
    for (const char c : text) EXPECT_TRUE(c >= ' ' && c <= '~');
}

}  // namespace
}  // namespace model
