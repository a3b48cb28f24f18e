// SPDX-License-Identifier: Apache-2.0
// A context of OpenGL 4.5 without a window, on a software rasteriser, whose messages fail the test.
#pragma once

#include "case_costs.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <string>
#include <utility>
#include <vector>

namespace gnomon::test {

class EglContext {
public:
    /// The one of the test program, which is current.
    [[nodiscard]] static EglContext& instance();

    /// Why there is none; empty where there is one.
    [[nodiscard]] const std::string& missing() const { return missing_; }
    [[nodiscard]] static void* function(const char* name);
    /// Fails the test for every error and every undefined behaviour that OpenGL has told of since the last call, and
    /// for errors of glGetError().
    void expectSilence();
    /// Messages that a case has asked for.
    void forget() { messages_.clear(); }
    void add(std::string message) { messages_.push_back(std::move(message)); }

private:
    EglContext();

    std::string missing_;
    std::vector<std::string> messages_;
};

} // namespace gnomon::test

/// Skips the case, and says so, where there is no such context. It draws where there is one.
#define GNOMON_NEEDS_EGL()                                                                                             \
    gnomon::test::noteDrawing();                                                                                       \
    if (!gnomon::test::EglContext::instance().missing().empty()) {                                                     \
        GTEST_SKIP() << gnomon::test::EglContext::instance().missing();                                                \
    }
