#pragma once
#include <map>
#include <string>

namespace lockstep {

/// What the running test case tells of itself besides its result, for the JUnit reporter.
struct TestNotes {
    std::string skipped;                           ///< why it could not be run; empty: it was
    std::map<std::string, std::string> properties; ///< renderer, profile, verdict
    std::string verdict;                           ///< of the last match: the line `verdict`
    std::string repeat;                            ///< the command that Catch2 3 would break, until it is told
};

inline TestNotes& test_notes() {
    static TestNotes notes;
    return notes;
}

} // namespace lockstep
