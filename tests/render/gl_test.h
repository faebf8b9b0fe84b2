// A context for the tests that draw. Without one they skip, and say so.
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <memory>
#include <string>

#include "render/gl/headless.h"

namespace tests {

class GlTest : public testing::Test {
protected:
    void SetUp() override {
        try {
            context_ = std::make_unique<render::gl::HeadlessContext>();
        } catch (const std::exception& error) {
            GTEST_SKIP() << "NO OPENGL CONTEXT, NOTHING IS TESTED HERE: " << error.what();
        }
    }

private:
    std::unique_ptr<render::gl::HeadlessContext> context_;
};

}  // namespace tests
