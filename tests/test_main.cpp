#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>

#include <cstdlib>
#include <iostream>

#include "tests/skip.hpp"

namespace {
int skipped = 0;
}

void lockstep::test::skip(const std::string& reason) {
    const char* required = std::getenv("LOCKSTEP_REQUIRE_GL");
    if (required != nullptr && std::string(required) == "1")
        FAIL("LOCKSTEP_REQUIRE_GL is set, but " << reason);
    ++skipped;
    std::cout << "skipped: " << reason << '\n';
}

int main(int argc, char** argv) {
    Catch::Session session;
    if (const int usage = session.applyCommandLine(argc, argv); usage != 0)
        return usage;
    if (session.run() != 0)
        return 1;
    return skipped > 0 ? 77 : 0;
}
