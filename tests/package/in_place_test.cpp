#include <fstream>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "tests/temporary_folder.hpp"

namespace lockstep::test::in_place_test {

using lockstep::test::TemporaryFolder;

/// Sparks that burn down: two buffers that a kernel changes in place, a count that it keeps beside them, a buffer of
/// the host's, and frames in which it does not run.
namespace {

namespace site {
inline constexpr Site heat{"heat", "heat"}, lit{"lit", "lit"}, was_lit{"lit before"}, loss{"loss"};
inline constexpr Site is_lit{"is lit"}, is_out{"goes out"}, burnt{"burnt", "burnt"};
} // namespace site

const Schema& schema() {
    static const Schema all =
        checked({"sparks",
                 {{.name = "sparks",
                   .item = "spark",
                   .title = "the sparks",
                   .fields = {{.name = "heat", .block = "heatBuffer"},
                              {.name = "lit", .scalar = Scalar::int32, .block = "litBuffer"}}},
                  {.name = "tally",
                   .item = "tally",
                   .title = "the tally",
                   .fields = {{.name = "burnt", .scalar = Scalar::uint32, .block = "burntBuffer"}}}}});
    return all;
}
constexpr FieldId heat{0, 0}, lit{0, 1}, burnt{1, 0};

float loss_in(int frame) { return 0.25F * static_cast<float>(frame % 3); }
bool runs(int frame) { return frame % 4 != 0; } // not in the first

struct Burn {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        struct Spark {
            typename R::Real heat;
            typename R::Int lit{};
            auto fields() const { return std::tie(heat, lit); }
        };
        Spark spark{r.read(site::heat, in.before.real(heat, item)),
                    r.uniform(site::was_lit, in.before.integer(lit, item))};
        if (!r.decide(site::is_lit, spark.lit == 1))
            return spark;
        spark.heat = r.note(site::heat, spark.heat - r.uniform(site::loss, loss_in(in.frame)) * 0.5F);
        if (r.decide(site::is_out, spark.heat < 0.0F))
            spark.lit = 0;
        return spark;
    }
};

struct Tally {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        struct State {
            typename R::Int burnt{};
            auto fields() const { return std::tie(burnt); }
        };
        int out = 0;
        for (std::size_t i = 0; i < in.before[0].count(); ++i)
            out += 1 - in.before.integer(lit, i);
        static_cast<void>(in.before.integer(burnt, item));
        return State{r.note(site::burnt, typename R::Int(out))};
    }
};

System sparks(std::size_t count) {
    System system{.name = "sparks",
                  .schema = schema(),
                  .passes = {},
                  .mistakes = {},
                  .start = {schema(), {{count}, {1}}},
                  .settings = {}};
    system.passes.push_back(item_pass({.name = "burn", .stage = PassStage::compute, .runs = runs}, Burn{}));
    system.passes.push_back(item_pass(
        {.name = "tally", .resource = 1, .stage = PassStage::compute, .runs = runs, .continues = true}, Tally{}));
    for (std::size_t i = 0; i < count; ++i) {
        system.start.set(heat, i, static_cast<float>(i % 23) * 0.13F);
        system.start.set(lit, i, std::int32_t{1});
    }
    return system;
}

std::vector<GlPass> passes() {
    GlPass burn{.name = "burn", .stage = Stage::compute};
    burn.data["lossBuffer"] = [](int frame) { return std::vector<float>{loss_in(frame)}; };
    burn.defines = {{"FACTOR", "0.5"}};
    burn.runs = runs;
    return {burn, {.name = "tally", .stage = Stage::compute, .resource = 1, .continues = true}};
}

const Gl& gl() {
    static const Gl one;
    return one;
}

std::string planted(const TemporaryFolder& folder, const std::string& what, const std::string& by) {
    std::ostringstream text;
    text << std::ifstream("tests/package/sparks/burn.comp").rdbuf();
    std::string shader = text.str();
    const std::size_t at = shader.find(what);
    REQUIRE(at != std::string::npos);
    std::ofstream(folder.path() / "burn.comp") << shader.replace(at, what.size(), by);
    return folder.path().string();
}

CheckReport run(const std::string& shaders, const System& system, CheckMode mode = CheckMode::resync) {
    GlSystemSide side(gl(), system, passes(), shaders);
    CheckOptions options;
    options.frames = 40;
    options.mode = mode;
    return check(system, side, options);
}

} // namespace

TEST_CASE("in place: a kernel that changes buffers where they lie, and keeps a count, agrees with its twins") {
    if (!gl())
        return skip(gl().missing());
    const std::size_t count = GENERATE(1, 63, 64, 65, 1000);
    const System system = sparks(count);
    for (const CheckMode mode : {CheckMode::resync, CheckMode::free}) {
        const CheckReport report = run("tests/package/sparks", system, mode);
        INFO(report_text(report, {}));
        CHECK(report.verdict == Verdict::agree);
        CHECK(report.total.compared() == std::uint64_t{30} * (2 * count + 1));
    }
}

TEST_CASE("in place: a wrong count and a wrong field diverge, each in its own pass") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const auto step_of = [&](const std::string& what, const std::string& by) {
        const System system = sparks(1000);
        const CheckReport report = run(planted(folder, what, by), system);
        REQUIRE(report.verdict == Verdict::divergent);
        return report.verdicts->first->wrong.step;
    };
    CHECK(step_of("atomicAdd(burnt, 1u);", "atomicAdd(burnt, 2u);") == "tally, burnt");
    CHECK(step_of("atomicAdd(burnt, 1u);", "") == "tally, burnt");
    CHECK(step_of("lit[i] = 0;", "") == "burn, lit");
    CHECK(step_of("loss[0] * FACTOR", "loss[0]") == "burn, heat");
}

TEST_CASE("in place: a kernel that writes behind the items, or a buffer that no twin is of, is an error") {
    if (!gl())
        return skip(gl().missing());
    const TemporaryFolder folder;
    const System system = sparks(1000);
    CHECK_THROWS_WITH(run(planted(folder, "if (i >= u_ItemCount || lit[i] == 0)\n        return;",
                                  "lit[i] = u_ItemCount == 0u ? 0 : lit[i] & 1;"),
                          system),
                      Catch::Contains("frame 1: burn (") && Catch::Contains("wrote past the end of") &&
                          Catch::Contains("(1000 sparks)"));
    GlSystem alone(system.schema, passes(), "tests/package/sparks");
    std::vector<GlPass> first = passes();
    first.erase(first.begin());
    CHECK_THROWS_WITH(GlSystem(system.schema, first, "tests/package/sparks"), Catch::Contains("and is the first"));
    CHECK_THROWS_WITH(run(planted(folder, "lossBuffer", "lostBuffer"), system),
                      Catch::Contains("nothing is given for storage block lostBuffer; right is one of "));
}

TEST_CASE("in place: a schema names storage blocks for all fields of a buffer, once each") {
    const auto of = [](const std::string& name, std::vector<Field> fields) {
        return Resource{.name = name, .item = name, .title = name, .fields = std::move(fields)};
    };
    const Field in_b{.name = "x", .block = "b"}, in_none{.name = "y"}, also_in_b{.name = "y", .block = "b"};
    CHECK_THROWS_WITH(checked({"s", {of("a", {in_b, in_none})}}), Catch::Contains("some fields have a storage block"));
    CHECK_THROWS_WITH(checked({"s", {of("a", {in_b}), of("c", {also_in_b})}}),
                      Catch::Contains("storage block 'b' stands there twice"));
}

} // namespace lockstep::test::in_place_test
