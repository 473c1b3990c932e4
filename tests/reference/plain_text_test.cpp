#include <catch2/catch.hpp>

#include <random>
#include <string>

#include "crosscheck/files/plain_text.hpp"
#include "crosscheck/files/shell_words.hpp"

namespace lockstep::test::plain_text_test {

TEST_CASE("plain text: what a terminal obeys instead of showing it is written out") {
    CHECK(plain_line("a\nverdict   AGREE\r\tb") == "a\\nverdict   AGREE\\r\\tb");
    CHECK(plain_line("\x1b[2J\x07\x7f") == "\\x1b[2J\\x07\\x7f");
    CHECK(plain_line(std::string("a\0b", 3)) == "a\\x00b");
    CHECK(plain_line("\xc2\x9b") == "\\u009b");                   // CSI in one character
    CHECK(plain_line("exe.\xe2\x80\xaetxt") == "exe.\\u202etxt"); // right to left override
    CHECK(plain_line("a\xe2\x81\xa6"
                     "b\xe2\x80\xa8"
                     "c") == "a\\u2066b\\u2028c"); // isolate, line separator
    CHECK(plain_line("\xef\xbb\xbf\xe2\x80\x8b\xf3\xa0\x81\x81") == "\\ufeff\\u200b\\ue0041");
}

TEST_CASE("plain text: bytes that are no UTF-8 are written out, all that are stay") {
    CHECK(plain_line("\xff\xc3(\xe2\x82") == "\\xff\\xc3(\\xe2\\x82");
    CHECK(plain_line("\xc0\xaf\xe0\x80\xaf\xed\xa0\x80\xf4\x90\x80\x80") ==
          "\\xc0\\xaf\\xe0\\x80\\xaf\\xed\\xa0\\x80\\xf4\\x90\\x80\\x80"); // longer than needed, surrogate, too high
    const std::string words = "Gr\xc3\xb6\xc3\x9f"
                              "e \xe6\xbc\xa2 \xf0\x9f\x90\xb0 a\\b 'c'";
    CHECK(plain_line(words) == words);
    CHECK(is_plain(words));
    CHECK_FALSE(is_plain("a\nb"));
}

TEST_CASE("plain text: of a report the line breaks stay, and nothing else that is not shown") {
    CHECK(plain_text("a\nb\x1b\n") == "a\nb\\x1b\n");
}

TEST_CASE("plain text: whatever comes in, what goes out is UTF-8 and plain") {
    std::mt19937 random(1);
    for (int i = 0; i < 20'000; ++i) {
        std::string text(random() % 12, '\0');
        for (char& c : text)
            c = static_cast<char>(random() % 3 == 0 ? random() : 0x80 + random() % 0x80);
        const std::string plain = plain_line(text);
        CHECK(plain_line(plain) == plain);
        CHECK(plain.find('\n') == std::string::npos);
    }
}

TEST_CASE("plain text: a word with such characters is one that a shell reads as it was") {
    CHECK(shell_word("a\nb'\x1b\\") == R"($'a\x0ab\'\x1b\\')");
    CHECK(shell_word("a b") == "'a b'");
}

} // namespace lockstep::test::plain_text_test
