#include <catch2/catch.hpp>

#include "crosscheck/package/folded_text.hpp"

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
