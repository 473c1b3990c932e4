#pragma once
/// main() of a test program with Catch2, version 2 or 3, skip(), and a reporter of one's own (junit_reporter.hpp);
/// included in one source file, before any other Catch2 header. Exit status: 0 all passed, 1 a test failed, 77 none
/// failed but some were skipped.
#define CATCH_CONFIG_RUNNER // of version 2; what version 3 is built with is a library
#ifndef CATCH_CONFIG_CONSOLE_WIDTH
#define CATCH_CONFIG_CONSOLE_WIDTH 120 // Catch2 breaks what is longer, also a path in a command line
#endif
#include "lockstep/catch2.hpp"
#if CATCH_VERSION_MAJOR >= 3
#include <catch2/catch_session.hpp>
#include <catch2/reporters/catch_reporter_event_listener.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>
#endif

#include <iostream>
#include <string>
#include <utility>

#include "lockstep/junit_reporter.hpp"
#include "lockstep/skip.hpp"
#include "lockstep/test_notes.hpp"

#if CATCH_VERSION_MAJOR >= 3
namespace lockstep {

/// Tells a repeat line that Catch2 is about to break, as it can be pasted.
class RepeatListener : public Catch::EventListenerBase {
  public:
    using Catch::EventListenerBase::EventListenerBase;
    void assertionEnded(const Catch::AssertionStats& stats) override {
        const Catch::AssertionResult& result = stats.assertionResult;
        if (!result.isOk() && !test_notes().repeat.empty() &&
            result.getExpandedExpression().find("is to match the reference") != std::string::npos)
            std::cout << '\n' << std::exchange(test_notes().repeat, {}) << std::endl;
    }
};

} // namespace lockstep
CATCH_REGISTER_LISTENER(lockstep::RepeatListener)
#endif

namespace {
int skipped_tests = 0;
}

void lockstep::skip(const std::string& reason, const std::string& required_by) {
    if (is_required(required_by))
        FAIL(required_by << " is set, but " << reason);
    ++skipped_tests;
    test_notes().skipped = reason;
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
