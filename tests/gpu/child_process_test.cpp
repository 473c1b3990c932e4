#include <catch2/catch.hpp>

#include <csignal>
#include <fstream>
#include <string>
#include <vector>

#include <unistd.h>

#include "gpu/child_process.hpp"

namespace lockstep::test::child_process_test {

TEST_CASE("child process: gives any bytes, and throws what its work throws") {
    const std::string bytes("a\0b\xff\n", 5);
    CHECK(in_child({"it"}, [&] { return bytes; }) == bytes);
    CHECK(in_child({"it"}, [] { return std::string(); }).empty());
    CHECK(in_child({"it"}, [] { return std::string(1 << 20, 'x'); }).size() == 1 << 20);
    CHECK_THROWS_WITH(in_child({"it"}, []() -> std::string { throw Error("line 3: a word is missing"); }),
                      "line 3: a word is missing");
}

TEST_CASE("child process: a crash, a hang and an exit are errors that name the subject") {
    const auto ends = [](auto work) {
        return [work]() -> std::string {
            work();
            return "";
        };
    };
    CHECK_THROWS_WITH(in_child({"the driver"}, ends([] { std::raise(SIGSEGV); })),
                      "the driver crashed with signal 11 (Segmentation fault)");
    CHECK_THROWS_AS(in_child({"the driver", 1}, ends([] { pause(); })), ChildFailed);
    CHECK_THROWS_WITH(in_child({"the driver", 1}, ends([] { pause(); })), "the driver did not answer within 1 s");
    CHECK_THROWS_WITH(in_child({"the driver"}, ends([] { _exit(0); })), "the driver ended the process");
}

TEST_CASE("child process: within the fence no file is opened, and memory is bounded") {
    CHECK(in_child({"it", 20, true},
                   [] { return std::string(std::ifstream("/proc/self/status") ? "open" : "shut"); }) == "shut");
    CHECK_THROWS_WITH(in_child({"it", 1, true},
                               []() -> std::string {
                                   std::string text(1, 'x');
                                   while (text.size() == 1)
                                       text.assign(1, static_cast<char>(text[0] + 1));
                                   return text;
                               }),
                      "it needs more than 1 s of processor time");
#ifndef __SANITIZE_ADDRESS__
    CHECK_THROWS_WITH(in_child({"it", 20, true}, [] { return std::string(std::size_t{3} << 30U, 'x').substr(0, 1); }),
                      "it needs too much memory");
#endif
}

TEST_CASE("child process: one within the fence that gets no turn is no Error of what it reads", "[.slow]") {
    const auto stopped = []() -> std::string {
        std::raise(SIGSTOP);
        return "";
    };
    CHECK_THROWS_AS(in_child({"it", 1, true}, stopped), ChildStarved);
}

} // namespace lockstep::test::child_process_test
