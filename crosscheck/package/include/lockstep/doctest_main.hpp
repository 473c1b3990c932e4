#pragma once
/// main() of a test program with doctest, and skip(); included in one source file, before any other doctest header.
/// Exit status: 0 all passed, 1 a test failed, 77 none failed but some were skipped.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <string>

#include "lockstep/skip.hpp"

namespace {
int skipped_tests = 0;
}

void lockstep::skip(const std::string& reason, const std::string& required_by) {
    if (is_required(required_by)) {
        const std::string problem = required_by + " is set, but " + reason;
        DOCTEST_FAIL(problem);
    }
    ++skipped_tests;
    const std::string told = "skipped: " + reason;
    DOCTEST_MESSAGE(told);
}

int main(int argc, char** argv) {
    doctest::Context context(argc, argv);
    const int status = context.run();
    if (status != 0 || context.shouldExit())
        return status;
    return skipped_tests > 0 ? 77 : 0;
}
