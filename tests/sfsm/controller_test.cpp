#include "sfsm/controller.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace sfsm {
namespace {

TEST(Laws, EveryListedNameMakesALaw) {
    ASSERT_FALSE(law_names().empty());
    EXPECT_EQ(law_names().front(), "predictive");
    for (const std::string_view name : law_names()) {
        const auto law = make_controller(name);
        ASSERT_NE(law, nullptr) << name;
        const Decision first = law->decide({16.6, 100});
        EXPECT_TRUE(first == Decision{} || first.state == State::points) << name;
        EXPECT_EQ(law->status().target_ms, 16.6) << name;
    }
}

TEST(Laws, AnUnknownNameIsAnsweredWithTheNamesThereAre) {
    try {
        make_controller("papier");
        FAIL() << "accepted";
    } catch (const std::invalid_argument& error) {
        const std::string message = error.what();
        EXPECT_NE(message.find("papier"), std::string::npos) << message;
        for (const std::string_view name : law_names()) EXPECT_NE(message.find(name), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace sfsm
