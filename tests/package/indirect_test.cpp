#include <fstream>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <lockstep/catch.hpp>
#include <lockstep/system.hpp>

#include "reference/system/item_words.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::indirect_test {

using lockstep::test::TemporaryFolder;

/// Cells of which a number grows that a kernel of one invocation counts for an indirect dispatch.
namespace {

namespace site {
inline constexpr Site before{"cell before"}, cell{"cell", "cell"}, living{"living"}, is_living{"is living"};
} // namespace site

const Schema& schema() {
    static const Schema all =
        checked({"cells",
                 {{.name = "cells", .item = "cell", .title = "the cells", .fields = {{.name = "cell"}}},
                  {.name = "counts",
                   .item = "count",
                   .title = "the counts",
                   .fields = {{.name = "groups", .scalar = Scalar::uint32, .components = 3, .block = "countBuffer"},
                              {.name = "living", .scalar = Scalar::uint32, .block = "countBuffer"}}}}});
    return all;
}
constexpr FieldId cell{0, 0}, groups{1, 0}, living{1, 1};

struct Count {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        ItemWords<R> words;
        const int count = item == 1 ? static_cast<int>(r.note(site::living, typename R::Int(in.frame * 37 % 300))) : 0;
        for (const int word : {(count + 63) / 64, item == 1 ? 1 : 0, item == 1 ? 1 : 0, count})
            words.add(static_cast<std::uint32_t>(word));
        return words;
    }
};

struct Grow {
    template <class R> auto operator()(R& r, const PassInput& in, std::size_t item) const {
        ItemWords<R> words;
        const std::size_t count = in.before.word(living, 1);
        if (item >= count)
            words.add(typename R::Real(in.before.real(cell, item)));
        else
            words.add(r.note(site::cell, r.read(site::before, in.before.real(cell, count - 1 - item)) + 1.5F));
        return words;
    }
};

System cells() {
    System system{.name = "cells",
                  .schema = schema(),
                  .passes = {},
                  .mistakes = {},
                  .start = {schema(), {{300}, {2}}},
                  .settings = {}};
    system.passes.push_back(item_pass({.name = "count", .resource = 1, .stage = PassStage::compute}, Count{}));
    system.passes.push_back(item_pass({.name = "grow", .stage = PassStage::compute}, Grow{}));
    return system;
}

const Gl& gl() {
    static const Gl one;
    return one;
}

CheckReport run(const std::string& shaders) {
    GlPass count{.name = "count", .stage = Stage::compute, .resource = 1};
    count.invocations = [](int) { return std::size_t{1}; };
    count.uniforms = [](int frame) -> Uniforms { return {{"u_Frame", static_cast<unsigned>(frame)}}; };
    GlPass grow{.name = "grow", .stage = Stage::compute};
    grow.indirect = GroupCounts{groups, 1};
    const System system = cells();
    GlSystemSide side(gl(), system, {count, grow}, shaders);
    CheckOptions options;
    options.frames = 30;
    return check(system, side, options);
}

} // namespace

TEST_CASE("indirect: a dispatch takes its groups from a buffer, and leaves the other items as they were") {
    if (!gl())
        return skip(gl().missing());
    const CheckReport report = run("tests/package/cells");
    INFO(report_text(report, {}));
    CHECK(report.verdict == Verdict::agree);
    CHECK(report.untried.empty());
}

TEST_CASE("indirect: a wrong group count is divergent in the buffer and in what it leaves out, and a huge one ends") {
    if (!gl())
        return skip(gl().missing());
    const std::string by = GENERATE("living / 64u", "4000000000u");
    const TemporaryFolder folder;
    std::filesystem::copy("tests/package/cells", folder.path());
    std::ostringstream text;
    text << std::ifstream("tests/package/cells/count.comp").rdbuf();
    std::string shader = text.str();
    const std::string right = "(living + 63u) / 64u";
    std::ofstream(folder.path() / "count.comp") << shader.replace(shader.find(right), right.size(), by);
    const CheckReport report = run(folder.path().string());
    CHECK(report.verdict == Verdict::divergent);
    CHECK((report.total.differing(0) > 0) == (by == "living / 64u"));
}

} // namespace lockstep::test::indirect_test
