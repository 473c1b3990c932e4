#pragma once
/// main() of a test program with Catch2 v2, and skip(); included in one source file, before any other Catch2 header.
/// Exit status: 0 all passed, 1 a test failed, 77 none failed but some were skipped.
#define CATCH_CONFIG_RUNNER
#ifndef CATCH_CONFIG_CONSOLE_WIDTH
#define CATCH_CONFIG_CONSOLE_WIDTH 120 // Catch2 breaks what is longer, also a path in a command line
#endif
#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>
#include <string>

#include "lockstep/skip.hpp"

namespace {
int skipped_tests = 0;
}

void lockstep::skip(const std::string& reason) {
    const char* required = std::getenv("LOCKSTEP_REQUIRE_GL");
    if (required != nullptr && std::string(required) == "1")
        FAIL("LOCKSTEP_REQUIRE_GL is set, but " << reason);
    ++skipped_tests;
    std::cout << "skipped: " << reason << '\n';
}

int main(int argc, char** argv) {
    Catch::Session session;
    if (const int usage = session.applyCommandLine(argc, argv); usage != 0)
        return usage;
    if (session.run() != 0)
        return 1;
    return skipped_tests > 0 ? 77 : 0;
}
