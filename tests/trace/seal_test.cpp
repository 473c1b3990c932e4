#include <algorithm>

#include <catch2/catch.hpp>

#include "crosscheck/record/seal.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::seal_test {

using Catch::Contains;
using test::error_of;

namespace {

struct Sealed {
    test::TemporaryFolder folder;
    std::filesystem::path file = folder.write("run.h5", std::string(seal_size, '\0').append("some thousand bytes"));
    Sealed() { seal_file(file); }
    [[nodiscard]] std::string refusal() const {
        return error_of([&] { check_seal(OpenedFile(file, "trace")); });
    }
    [[nodiscard]] std::string refusal_of(const std::string& bytes) const {
        test::write_bytes(file, bytes);
        return refusal();
    }
};

} // namespace

TEST_CASE("seal: a sealed file passes, and its seal is text that sha256sum and xxhsum agree with") {
    const Sealed sealed;
    CHECK(sealed.refusal().empty());
    const std::string bytes = test::bytes_of(sealed.file);
    CHECK_THAT(bytes, Catch::StartsWith("lockstep trace 1\nbytes 531\nsha256 "
                                        "7956b92b4100ca7c3335113a1383026ea86edf4dba2a2eb31fa09c2b889f3266\n"
                                        "xxh128 9096c5a4d608024fc8c7a98cd36f4683\n"));
    CHECK(parse_seal(bytes.substr(0, seal_size), "x").bytes == 531);
}

TEST_CASE("seal: what was cut off, made longer or changed by a bit is refused") {
    const Sealed sealed;
    const std::string bytes = test::bytes_of(sealed.file);
    CHECK_THAT(sealed.refusal_of(bytes.substr(0, 520)), Contains("cut off: 520 of its 531 bytes are here"));
    CHECK_THAT(sealed.refusal_of(bytes + "x"), Contains("damaged: 532 bytes, but 531 were sealed"));
    std::string digit = bytes;
    digit[digit.find("4683\n") + 3] = '7'; // the seal's last
    CHECK_THAT(sealed.refusal_of(digit), Contains("d36f4683, sealed was 9096") && Contains("d36f4687"));
    for (const std::size_t place : {std::size_t{512}, std::size_t{520}, bytes.size() - 1}) {
        std::string changed = bytes;
        changed[place] = static_cast<char>(changed[place] ^ 1);
        CHECK_THAT(sealed.refusal_of(changed), Contains("damaged: its XXH128 is "));
    }
}

TEST_CASE("seal: a seal of SHA-256 alone is held as well") {
    const Sealed sealed;
    std::string bytes = test::bytes_of(sealed.file);
    const std::size_t line = bytes.find("xxh128 ");
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(line), bytes.begin() + seal_size, '\0');
    CHECK(sealed.refusal_of(bytes).empty());
    std::string changed = bytes;
    changed.back() = static_cast<char>(changed.back() ^ 1);
    CHECK_THAT(sealed.refusal_of(changed), Contains("damaged: its SHA-256 is ") && Contains("sealed was 7956b92b"));
    std::string digit = bytes;
    digit[digit.find("3266\n") + 3] = '7';
    CHECK_THAT(sealed.refusal_of(digit), Contains("2b889f3266, sealed was 7956") && Contains("2b889f3267"));
}

TEST_CASE("seal: a file of another kind is refused by its first line") {
    const Sealed sealed;
    CHECK_THAT(sealed.refusal_of("{}"), Contains("not a trace: its first line is not \"lockstep trace 1\""));
    CHECK_THAT(sealed.refusal_of(""), Contains("empty"));
    CHECK_THAT(sealed.refusal_of("\x89HDF\r\n\x1a\n and so on"), Contains("not a trace"));
    CHECK_THAT(error_of([&] { check_seal(OpenedFile(sealed.folder.path(), "trace")); }),
               Contains("a folder, not a trace"));
    CHECK_THAT(error_of([&] { check_seal(OpenedFile(sealed.folder.path() / "none.h5", "trace")); }),
               Contains("none.h5: cannot be opened: No such file"));
}

TEST_CASE("seal: a seal that was touched is refused, line by line") {
    const std::string good = seal_text({531, std::string(64, 'a'), std::string(32, 'b')});
    const auto refusal = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        text.resize(seal_size, '\0');
        return error_of([&] { parse_seal(text, "run.h5"); });
    };
    CHECK(refusal("bytes", "bytes").empty());
    CHECK_THAT(refusal("bytes 531", "bytes x"), Contains("run.h5: damaged: its second line"));
    CHECK_THAT(refusal("bytes 531", "bytes 5e1"), Contains("its second line"));
    CHECK_THAT(refusal("bytes 531", "bytes -1"), Contains("its second line"));
    CHECK_THAT(refusal("bytes 531", "bytes 99999999999999999999"), Contains("its second line"));
    CHECK_THAT(refusal("bytes 531\n", ""), Contains("its second line"));
    CHECK_THAT(refusal("sha256 a", "sha256 g"), Contains("its third line"));
    CHECK_THAT(refusal("sha256 a", "sha256 "), Contains("its third line"));
    CHECK_THAT(refusal("xxh128 b", "xxh128 g"), Contains("its fourth line"));
    CHECK_THAT(refusal("xxh128 b", "xxh128 "), Contains("its fourth line"));
    CHECK_THAT(refusal("xxh128 b", "xxh129 b"), Contains("something other"));
    CHECK_THAT(refusal("b\n", "b\nx"), Contains("something other than zero bytes"));
    CHECK_THAT(error_of([&] { parse_seal(good.substr(0, 40), "run.h5"); }), Contains("its third line"));
}

} // namespace lockstep::test::seal_test
