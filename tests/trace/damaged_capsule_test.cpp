#include <catch2/catch.hpp>

#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "crosscheck/collision/record/capsule_json.hpp"
#include "crosscheck/files/json_reader.hpp"
#include "reference/model/error.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::damaged_capsule_test {

namespace {

/// Files of each kind of damage: 60, or what LOCKSTEP_DAMAGED_FILES says (ctest -C long: 600).
int cases() {
    const char* set = std::getenv("LOCKSTEP_DAMAGED_FILES");
    return set == nullptr ? 60 : std::atoi(set);
}

std::vector<std::string> originals() {
    std::vector<std::string> texts;
    for (const auto& entry : std::filesystem::directory_iterator("tests/fuzz/corpus/capsule"))
        texts.push_back(test::bytes_of(entry.path()));
    REQUIRE(texts.size() >= 2);
    return texts;
}

/// Whether the capsule is read and told; an Error is the other right answer.
bool told(const std::string& text) {
    try {
        const nlohmann::json document = parse_json(text, "capsule");
        const Capsule capsule = read_capsule(JsonValue(document, "capsule"));
        CHECK_FALSE(capsule_text(capsule, NumberFormat::hexadecimal).empty());
        return true;
    } catch (const Error& error) {
        CHECK(std::string(error.what()).size() < 2000);
        return false;
    }
}

/// A number or a word in quotes from one place of the text in another.
void move_a_value(std::string& text, std::mt19937_64& random) {
    const auto value_at = [&](std::size_t from) {
        const std::size_t first = text.find_first_of("0123456789\"", from);
        const std::size_t last = first == std::string::npos ? first : text.find_first_of(",:]}", first);
        return std::pair{first, last};
    };
    const auto [from, from_end] = value_at(random() % text.size());
    const auto [to, to_end] = value_at(random() % text.size());
    if (from_end == std::string::npos || to_end == std::string::npos)
        return;
    text.replace(to, to_end - to, text.substr(from, from_end - from));
}

} // namespace

TEST_CASE("damaged capsules: changed bytes end in an error or a verdict") {
    const auto whole = originals();
    std::mt19937_64 random(5);
    int refused = 0;
    for (int i = 0; i < cases(); ++i) {
        std::string text = whole[random() % whole.size()];
        for (std::uint64_t changes = 1 + random() % 6; changes > 0; --changes) {
            char& byte = text[random() % text.size()];
            byte = static_cast<char>(random() % 2 == 0 ? random() : '0' + random() % 10);
        }
        INFO("file " << i);
        refused += told(text) ? 0 : 1;
    }
    CHECK(refused > cases() / 3);
}

TEST_CASE("damaged capsules: values in each other's places end in an error or a verdict") {
    const auto whole = originals();
    std::mt19937_64 random(6);
    int refused = 0;
    for (int i = 0; i < cases(); ++i) {
        std::string text = whole[random() % whole.size()];
        for (std::uint64_t changes = 1 + random() % 3; changes > 0; --changes)
            move_a_value(text, random);
        INFO("file " << i);
        refused += told(text) ? 0 : 1;
    }
    CHECK(refused > cases() / 6);
}

TEST_CASE("damaged capsules: a few kilobytes cannot ask for gigabytes") {
    nlohmann::json document = nlohmann::json::parse(originals().front());
    document["settings"]["image"] = {16384, 16384};
    try {
        read_capsule(JsonValue(document, "capsule"));
        FAIL("an image of 4 GiB is too much");
    } catch (const Error& error) {
        CHECK_THAT(error.what(), Catch::StartsWith("capsule: asks for about 25.0 GiB of memory"));
    }
}

TEST_CASE("damaged capsules: what is shown cannot pass for lines of a report, nor steer a terminal") {
    nlohmann::json document = nlohmann::json::parse(originals().front());
    const std::string forged = "x\nverdict   AGREE\x1b[2J";
    for (const char* key : {"scene", "renderer", "switches"})
        document[key] = forged;
    document["profile"]["name"] = forged;
    const std::string text = capsule_text(read_capsule(JsonValue(document, "capsule")), NumberFormat::hexadecimal);
    CHECK(text.find('\x1b') == std::string::npos);
    CHECK(text.find("\nverdict   AGREE") == std::string::npos);
    CHECK(text.find("x\\nverdict   AGREE\\x1b[2J") != std::string::npos);
}

} // namespace lockstep::test::damaged_capsule_test
