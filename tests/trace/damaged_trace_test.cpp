#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/record/trace_side.hpp"
#include "crosscheck/record/seal.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"
#include "reference/model/state_hash.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/trace/small_trace.hpp"

namespace lockstep::test::damaged_trace_test {

using Catch::Contains;

namespace {

constexpr int frames = 4;

/// Files of each kind of damage: 60, or what LOCKSTEP_DAMAGED_FILES says (ctest -C long: 600).
int cases() {
    const char* set = std::getenv("LOCKSTEP_DAMAGED_FILES");
    return set == nullptr ? 60 : std::atoi(set);
}

/// Every state of a trace, as far as it can be read.
struct Reading {
    std::string refusal; ///< empty: all of it was read
    Verdict verdict = Verdict::differ;
    std::size_t warnings = 0;
    bool has_cdt = false;
    std::vector<std::uint64_t> hashes;       ///< of the start and each frame
    std::vector<std::uint64_t> of_particles; ///< the same without the CDT
};

Reading reading_of(const std::filesystem::path& file) {
    Reading reading;
    try {
        TraceReader trace(file);
        TraceSide recorded(trace);
        reading.warnings = trace.info().warnings.size();
        reading.has_cdt = trace.info().has_cdt;
        reading.hashes.push_back(state_hash(trace.info().scene.start, CollisionImage()));
        reading.of_particles = reading.hashes;
        FrameCheckOptions options;
        options.frames = trace.info().frames;
        options.known = known_operations(trace.info());
        options.on_state = [&](const ComparedFrame& frame) {
            // A CDT that was not recorded is drawn of the scene's text, which a file may change without touching a
            // state.
            reading.of_particles.push_back(state_hash(frame.gpu, CollisionImage()));
            reading.hashes.push_back(state_hash(frame.gpu, trace.info().has_cdt ? frame.gpu_cdt : CollisionImage{}));
        };
        reading.verdict = check(trace.info().scene, followed_profile(trace.info()), recorded, options).verdict;
    } catch (const Error& error) {
        reading.refusal = error.what();
        CHECK(!reading.refusal.empty());
    }
    return reading;
}

/// AGREE is said of the states that were recorded, or of the first ones with a warning, and of nothing else.
bool trusted_rightly(const Reading& original, const Reading& damaged) {
    if (!damaged.refusal.empty() || damaged.verdict != Verdict::agree)
        return true;
    const bool whole = damaged.hashes.size() == original.hashes.size() || damaged.warnings > 0;
    // Where damage took the CDT, the verdict speaks of particles alone, and a note says so.
    const auto& told = damaged.has_cdt ? damaged.hashes : damaged.of_particles;
    const auto& recorded = damaged.has_cdt ? original.hashes : original.of_particles;
    return whole && told.size() <= recorded.size() && std::equal(told.begin(), told.end(), recorded.begin());
}

struct Original {
    test::TemporaryFolder folder;
    std::filesystem::path file = folder.path() / "run.h5";
    std::string bytes;
    Reading reading;

    explicit Original(bool has_cdt) {
        test::record(file, test::small_info(has_cdt), frames);
        bytes = test::bytes_of(file);
        reading = reading_of(file);
        CHECK(reading.verdict == Verdict::agree);
        REQUIRE(reading.hashes.size() == frames + 1);
    }
};

/// The process that reads for this one.
int reading_process() {
    std::ifstream children("/proc/self/task/" + std::to_string(getpid()) + "/children");
    int pid = -1;
    children >> pid;
    return pid;
}

} // namespace

TEST_CASE("damaged traces: those that were cut off are refused") {
    const Original original(true);
    std::mt19937_64 random(1);
    for (int i = 0; i < cases(); ++i) {
        test::write_bytes(original.file, original.bytes.substr(0, random() % original.bytes.size()));
        CHECK(!reading_of(original.file).refusal.empty());
    }
}

TEST_CASE("damaged traces: those with flipped bits are refused") {
    const Original original(true);
    std::mt19937_64 random(2);
    for (int i = 0; i < cases(); ++i) {
        std::string bytes = original.bytes;
        for (std::uint64_t flips = 1 + random() % 8; flips > 0; --flips) {
            char& byte = bytes[random() % bytes.size()];
            byte = static_cast<char>(byte ^ (1 << random() % 8));
        }
        if (bytes == original.bytes)
            continue;
        test::write_bytes(original.file, bytes);
        CHECK(!reading_of(original.file).refusal.empty());
    }
}

TEST_CASE("damaged traces: those changed and sealed again end in an error or a verdict, and no false AGREE") {
    int refused = 0, agreed = 0;
    for (const bool has_cdt : {true, false}) {
        const Original original(has_cdt);
        std::mt19937_64 random(has_cdt ? 3 : 4);
        for (int i = 0; i < cases(); ++i) {
            std::string bytes = original.bytes;
            for (std::uint64_t changes = 1 + random() % 12; changes > 0; --changes) {
                const std::size_t place = seal_size + random() % (bytes.size() - seal_size);
                switch (random() % 4) {
                case 0:
                    bytes[place] = static_cast<char>(random());
                    break;
                case 1:
                    bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
                    break;
                case 2:
                    std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(place),
                                std::min<std::size_t>(8, bytes.size() - place), random() % 2 == 0 ? '\xff' : '\0');
                    break;
                default:
                    bytes.resize(place + 1);
                }
            }
            test::write_bytes(original.file, bytes);
            seal_file(original.file);
            const Reading damaged = reading_of(original.file);
            INFO("file " << i << " " << damaged.refusal);
            CHECK(trusted_rightly(original.reading, damaged));
            (damaged.refusal.empty() ? agreed : refused) += 1;
        }
    }
    CHECK(refused > cases() / 2);
    CHECK(agreed > cases() / 12); // changes that nobody reads: else this test would prove nothing about verdicts
}

TEST_CASE("damaged traces: a state changed on purpose, all checksums right, is no AGREE") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    for (const int frame : {0, 1, frames - 1}) {
        test::record(file, test::small_info(false), frames, [&](int at, Particles& particles, CollisionImage&) {
            if (at == frame)
                particles.position[3].x = -particles.position[3].x;
        });
        CHECK(reading_of(file).verdict == Verdict::divergent);
    }
}

TEST_CASE("damaged traces: a reading process that dies is an error, whatever it was doing") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    test::record(file, test::small_info(true), frames);
    TraceReader trace(file);
    const int pid = reading_process();
    REQUIRE(pid > 0);
    REQUIRE(kill(pid, SIGSEGV) == 0);
    Particles particles;
    const std::string refusal = test::error_of([&] {
        trace.read(0, particles);
        trace.read(2, particles);
    });
    CHECK_THAT(refusal, Contains("run.h5: HDF5 broke on it (Segmentation fault)"));
    CHECK_THAT(test::error_of([&] { trace.read(1, particles); }), Contains("HDF5 broke on it"));
}

TEST_CASE("damaged traces: a reading process that somebody kills is not the file's fault") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    test::record(file, test::small_info(true), frames);
    for (const auto& [signal, told] :
         {std::pair{SIGKILL, "the process that reads it was killed from outside (Killed)"},
          std::pair{SIGTERM, "the process that reads it was ended from outside (Terminated); try again"},
          std::pair{SIGXCPU, "reading one state of it took over a minute of processor time"}}) {
        TraceReader trace(file);
        REQUIRE(kill(reading_process(), signal) == 0);
        Particles particles;
        CHECK_THAT(test::error_of([&] {
                       trace.read(0, particles);
                       trace.read(2, particles);
                   }),
                   Catch::StartsWith(file.string() + ": " + told));
    }
}

TEST_CASE("damaged traces: no verdict on bytes that no seal was held against, whoever swaps files meanwhile") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5", sealed = folder.path() / "sealed", other = folder.path() / "other";
    test::record(sealed, test::small_info(false), frames);
    TraceInfo info = test::small_info(false);
    info.renderer = "another renderer";
    test::record(other, info, frames);
    test::write_bytes(other, seal_text({}) + test::bytes_of(other).substr(seal_size));
    std::filesystem::create_hard_link(sealed, file);
    std::atomic<bool> over = false;
    std::thread swapping([&] {
        for (int i = 0; !over; ++i) {
            const auto next = folder.path() / "next";
            std::filesystem::create_hard_link(i % 2 == 0 ? other : sealed, next);
            std::filesystem::rename(next, file);
            std::this_thread::sleep_for(std::chrono::microseconds(100 << i % 10));
        }
    });
    // A refusal is quick: as many tries as it takes until some meet a file that stays.
    int read = 0, refused = 0;
    constexpr int most = 1'000'000;
    for (int i = 0; i < 150 || ((read == 0 || refused == 0) && i < most); ++i) {
        std::string renderer = "a renderer";
        const std::string refusal = test::error_of([&] { renderer = TraceReader(file).info().renderer; });
        CHECK(renderer == "a renderer");
        (refusal.empty() ? read : refused) += 1;
    }
    over = true;
    swapping.join();
    CHECK(read > 0);
    CHECK(refused > 0);
}

TEST_CASE("damaged traces: a file that is written while it is read is refused") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    test::record(file, test::small_info(false), frames);
    TraceReader trace(file);
    std::ofstream(file, std::ios::app) << "more";
    Particles particles;
    CHECK_THAT(test::error_of([&] { trace.read(0, particles); }), Contains("run.h5: was written while it was read"));
}

TEST_CASE("damaged traces: the reading process can write nothing, open nothing more, and take so much memory") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    test::record(file, test::small_info(true), frames);
    const TraceReader trace(file);
    const std::string limits = test::bytes_of("/proc/" + std::to_string(reading_process()) + "/limits");
    CHECK_THAT(limits, Catch::Matches("(.|\n)*Max file size +0 +0 (.|\n)*"));
    CHECK_THAT(limits, Catch::Matches("(.|\n)*Max core file size +0 +0 (.|\n)*"));
    CHECK_THAT(limits, Catch::Matches("(.|\n)*Max processes +0 +0 (.|\n)*"));
    CHECK_THAT(limits, Catch::Matches("(.|\n)*Max open files +\\d{1,2} +\\d{1,2} (.|\n)*"));
    CHECK_THAT(limits, Catch::Matches("(.|\n)*Max address space +\\d+ (.|\n)*"));
    CHECK_THAT(limits, Catch::Matches("(.|\n)*Max cpu time +\\d+ (.|\n)*"));
    CHECK_THAT(test::bytes_of("/proc/" + std::to_string(reading_process()) + "/status"), Contains("Seccomp:\t2\n"));
    CHECK(trace.info().warnings.empty());
    std::vector<std::string> open_ones;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(reading_process()) + "/fd"))
        open_ones.push_back(std::filesystem::read_symlink(entry));
    CHECK(open_ones.size() == 6); // standard ones, requests, answers, the file
    CHECK(std::count(open_ones.begin(), open_ones.end(), file.string()) == 1);
}

TEST_CASE("damaged traces: no reading process stays behind") {
    const test::TemporaryFolder folder;
    const auto file = folder.path() / "run.h5";
    test::record(file, test::small_info(false), frames);
    { const TraceReader trace(file); }
    CHECK(reading_process() == -1);
    test::tamper(file, [](std::string& bytes) { std::fill(bytes.begin() + 512, bytes.begin() + 700, 'x'); });
    CHECK_THAT(test::error_of([&] { const TraceReader trace(file); }), Contains("run.h5: HDF5: "));
    CHECK(reading_process() == -1);
}

} // namespace lockstep::test::damaged_trace_test
