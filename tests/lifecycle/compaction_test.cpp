#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/lifecycle/lifecycle_run.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::compaction_test {

namespace lifecycle = lockstep::lifecycle;

namespace {

/// Particles that die at different ages, listed by an atomic counter.
lifecycle::Settings atomic(const std::string& preset = "paper") {
    lifecycle::Settings s;
    s.switches = lifecycle::preset(preset);
    s.switches.compaction = lifecycle::Compaction::atomic;
    lifecycle::Emitter& e = s.emitters.front();
    e.capacity = 3000;
    e.rate = 6000.0;
    e.lifetime = {0.1F, 0.4F};
    e.shape = lifecycle::Emitter::Shape::box;
    e.min = {-1.0F, 0.0F, -1.0F};
    e.max = {1.0F, 0.5F, 1.0F};
    return s;
}

/// The shipped shaders with one text of destroy.comp changed.
std::string planted(const TemporaryFolder& folder, const std::string& what, const std::string& by) {
    for (const auto& entry : std::filesystem::directory_iterator("shaders/lifecycle"))
        std::filesystem::copy_file(entry.path(), folder.path() / entry.path().filename());
    std::ostringstream text;
    text << std::ifstream("shaders/lifecycle/destroy.comp").rdbuf();
    std::string shader = text.str();
    const std::size_t at = shader.find(what);
    REQUIRE(at != std::string::npos);
    std::ofstream(folder.path() / "destroy.comp") << shader.replace(at, what.size(), by);
    return folder.path().string();
}

} // namespace

TEST_CASE("compaction: what an atomic counter lists may have any order, and is the same multiset") {
    if (!gl())
        return skip(gl().missing());
    const CheckReport report = run_lifecycle(atomic(GENERATE("paper", "corrected")), 40);
    INFO(report_text(report, {}));
    CHECK((report.verdict == Verdict::agree || report.verdict == Verdict::legal));
}

TEST_CASE("compaction: another order is legal, a lost, a doubled and a moved survivor each a cause of its own") {
    if (!gl())
        return skip(gl().missing());
    const std::string append = "survivors[next_list() + atomicAdd(counters[u_Emitter].append, 1u)] = slot_at(i);";
    const TemporaryFolder folder;
    const auto run = [&](const std::string& by) {
        const CheckReport report = run_lifecycle(atomic(), 30, CheckMode::resync, planted(folder, append, by));
        std::string cause;
        if (report.verdicts && !report.verdicts->causes[lifecycle::survivor_buffer].best.empty())
            cause = report.verdicts->causes[lifecycle::survivor_buffer].best.front().name();
        return std::pair(report.verdict, cause);
    };
    using Found = std::pair<Verdict, std::string>;
    SECTION("backwards") {
        const auto found = run("{ uint at = atomicAdd(counters[u_Emitter].append, 1u);\n"
                               "uint n = 0u;\n"
                               "for (uint k = 0u; k < counters[u_Emitter].may_die; ++k) n += survives(k) ? 1u : 0u;\n"
                               "survivors[u_Base + n - 1u - at] = i; }");
        CHECK(found == Found(Verdict::legal, ""));
    }
    SECTION("doubled") {
        CHECK(run("survivors[u_Base + atomicAdd(counters[u_Emitter].append, 1u)] = (i & 1u) == 1u && survives(i - 1u) "
                  "? i - 1u : i;") == Found(Verdict::divergent, "items_doubled"));
    }
    SECTION("lost") {
        CHECK(
            run("{ uint at = atomicAdd(counters[u_Emitter].append, 1u); if (at != 3u) survivors[u_Base + at] = i; else "
                "survivors[u_Base + at] = 0xffffffu; }") == Found(Verdict::divergent, "items_lost"));
    }
    SECTION("moved") {
        CHECK(run("survivors[u_Base + 1u + atomicAdd(counters[u_Emitter].append, 1u)] = i;").first ==
              Verdict::divergent);
    }
}

TEST_CASE("compaction: the walk lists the survivors that the twin lists one by one") {
    lifecycle::Settings s = atomic(GENERATE("paper", "exact"));
    s.switches.compaction = GENERATE(lifecycle::Compaction::atomic, lifecycle::Compaction::scan);
    s.switches.may_die = lifecycle::MayDie::all;
    s.emitters.push_back(s.emitters.front());
    const System system = lifecycle::system(host_of(s));
    ReferenceRun run = reference_of(system);
    std::size_t seen = 0;
    for (int frame = 0; frame < 25; ++frame)
        for (std::size_t p = 0; p < system.passes.size(); ++p) {
            const ItemPass& pass = *system.passes[p];
            const SystemState before = run.state();
            run.step_pass(p, frame);
            if (pass.name() != "destroy" || frame % 8 != 0)
                continue;
            const SystemView view = before.view();
            for (std::size_t item = 0; item < before.extent(pass.resource()).count(); item += 37) {
                ++seen;
                if (pass.mistaken({view, frame}, item, Profile{}, {}) != item_words(run.state()[pass.resource()], item))
                    FAIL_CHECK("frame " << frame << ", item " << item);
            }
        }
    CHECK(seen > 300);
}

} // namespace lockstep::test::compaction_test
