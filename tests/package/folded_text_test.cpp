#include <catch2/catch.hpp>

#include "crosscheck/package/folded_text.hpp"

namespace lockstep::test::folded_text_test {

using lockstep::failure_first;
using lockstep::folded_text;

TEST_CASE("folded text: what fits stays as it is, but for empty lines") {
    CHECK(folded_text("scene     x: 300 particles\n\n  field  differing\nrepeat    lockstep check x.json\n", 80, 60) ==
          "scene     x: 300 particles\n  field  differing\nrepeat    lockstep check x.json\n");
}

TEST_CASE("folded text: a long line goes on under its text") {
    CHECK(folded_text("profile   dot x + (y + z), subnormals flushed\n", 28, 60) == "profile   dot x + (y + z),\n"
                                                                                    "            subnormals\n"
                                                                                    "            flushed\n");
}

TEST_CASE("folded text: a command goes on as a shell reads it") {
    CHECK(folded_text("repeat    lockstep check a.json --frames 20 --shaders 'my own shaders'\n", 36, 60) ==
          "repeat    lockstep check a.json \\\n"
          "            --frames 20 --shaders \\\n"
          "            'my own shaders'\n");
    CHECK(folded_text("          again: lockstep explain a.json --frame 20\n", 36, 60) ==
          "          again: lockstep explain \\\n"
          "            a.json --frame 20\n");
}

TEST_CASE("folded text: a word that is wider than a line stays whole") {
    CHECK(folded_text("repeat    lockstep check /a/long/way/to/the/scene.json --frames 2\n", 28, 60) ==
          "repeat    lockstep check \\\n"
          "            /a/long/way/to/the/scene.json \\\n"
          "            --frames 2\n");
    CHECK(folded_text("verdict   /one/word/without/any/space/in/it\n", 20, 60) ==
          "verdict   /one/word/without/any/space/in/it\n");
}

TEST_CASE("folded text: what is too much is left out above the last line") {
    CHECK(folded_text("a\nb\nc\nd\ne\nrepeat    f\n", 80, 4) == "a\nb\n  ...\nrepeat    f\n");
    CHECK(folded_text("a\nb\nc\nd\nrepeat    lockstep check a.json\n", 26, 4) ==
          "a\n  ...\nrepeat    lockstep check \\\n            a.json\n");
}

TEST_CASE("failure first: verdict, cause, first difference and the repeat line, then the rest as it was") {
    CHECK(failure_first("scene     a\n"
                        "power     88 of 101\n"
                        "          not: this\n"
                        "note      of rows\n"
                        "verdict   DIVERGENT\n"
                        "classes   3 divergent\n"
                        "first     frame 1\n"
                        "          reference: 1\n"
                        "cause     all 3\n"
                        "          again: lockstep explain\n"
                        "\n"
                        "  worst of frame 1\n"
                        "\n"
                        "repeat    lockstep check\n") == "verdict   DIVERGENT\n"
                                                         "cause     all 3\n"
                                                         "first     frame 1\n"
                                                         "          reference: 1\n"
                                                         "note      of rows\n"
                                                         "          again: lockstep explain\n"
                                                         "repeat    lockstep check\n"
                                                         "scene     a\n"
                                                         "power     88 of 101\n"
                                                         "          not: this\n"
                                                         "classes   3 divergent\n"
                                                         "\n"
                                                         "  worst of frame 1\n"
                                                         "\n");
    CHECK(failure_first("") == "");
}

} // namespace lockstep::test::folded_text_test
