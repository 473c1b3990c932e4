#include <catch2/catch.hpp>

#include <bit>
#include <limits>

#include "crosscheck/judge/compare.hpp"
#include "reference/model/collision/collision_state.hpp"
#include "reference/model/error.hpp"
#include "reference/model/random.hpp"
#include "reference/model/schema.hpp"
#include "reference/model/state_hash.hpp"

namespace lockstep::test::schema_test {

namespace {

/// A grain with an int, a packed particle and its counters, and two images: what other systems' states are made of.
Schema mixed_schema() {
    return {"mixed",
            {{.name = "grains",
              .item = "grain",
              .title = "the grains",
              .fields = {{"position", Scalar::float32, 3, "world units"}, {"alive", Scalar::int32}},
              .counted = true},
             {.name = "packed",
              .item = "particle",
              .title = "the packed particles",
              .fields = {{"xy",
                          Scalar::uint32,
                          1,
                          "world units",
                          {{"x", 16, 16, Packed::Code::half}, {"y", 0, 16, Packed::Code::half}}}}},
             {.name = "volume",
              .item = "voxel",
              .title = "the volume",
              .fields = {{"sum", Scalar::uint32}},
              .dimensions = 3,
              .format = "r32ui"}}};
}

std::string complaint(const Schema& schema) {
    try {
        checked(schema);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// Values of a resource that nothing typed holds.
struct Plain {
    Plain(const Schema& schema, std::uint8_t resource, Extent extent_) : extent(extent_) {
        for (const Field& field : schema.resources[resource].fields)
            columns.emplace_back(extent.count() * static_cast<std::size_t>(field.components));
        view = {&schema, resource, extent, {}};
        for (std::vector<std::uint32_t>& column : columns)
            view.columns.push_back(reinterpret_cast<std::byte*>(column.data()));
    }
    Extent extent;
    std::vector<std::vector<std::uint32_t>> columns;
    WritableView view;
};

/// The documented sum, word by word.
std::uint64_t hash_by_hand(std::uint64_t seed, const std::vector<std::uint32_t>& words) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < words.size(); ++i)
        sum += splitmix64(seed + (std::uint64_t{i} << 32U | words[i]));
    return splitmix64(sum ^ words.size());
}

std::vector<std::uint32_t> words_of(const Particles& particles, float (*component)(const ParticleState&, int), int n) {
    std::vector<std::uint32_t> words;
    for (std::size_t i = 0; i < particles.size(); ++i)
        for (int c = 0; c < n; ++c)
            words.push_back(std::bit_cast<std::uint32_t>(component(particles[i], c)));
    return words;
}

} // namespace

TEST_CASE("schema: the collision system's and one of ints, packed words and a volume are whole") {
    CHECK_NOTHROW(checked(collision_schema()));
    const Schema mixed = checked(mixed_schema());
    CHECK(mixed.column({2, 0}) == 3);
    CHECK(glsl_type(mixed[{0, 0}]) == "vec3");
    CHECK(glsl_type(mixed[{0, 1}]) == "int");
    CHECK(glsl_type(mixed[{1, 0}]) == "uint");
    CHECK(component_name(mixed[{0, 0}], 2) == "position.z");
    CHECK(component_name(mixed[{0, 1}], 0) == "alive");
    CHECK(item_bytes(mixed.resources[0]) == 16);
}

TEST_CASE("schema: what does not fit together is refused by name") {
    Schema twice = mixed_schema();
    twice.resources[1].fields[0].name = "alive";
    CHECK(complaint(twice) == "schema of mixed: field 'alive' stands there twice");
    Schema overlapping = mixed_schema();
    overlapping.resources[1].fields[0].packed[1].shift = 1;
    CHECK(complaint(overlapping) == "schema of mixed: field 'xy': 'y' shares bits with another part");
    Schema wide = mixed_schema();
    wide.resources[0].fields[0].components = 5;
    CHECK(complaint(wide) == "schema of mixed: field 'position' has 5 components; right is 1 to 4");
    Schema growing = mixed_schema();
    growing.resources[2].counted = true;
    CHECK(complaint(growing) ==
          "schema of mixed: image 'volume' has 1 fields and is counted; right is one, and as many "
          "texels in every frame");
    Schema spaced = mixed_schema();
    spaced.resources[0].name = "two words";
    CHECK(complaint(spaced) ==
          "schema of mixed: buffer or image 'two words'; right is a name of letters, digits and _");
    CHECK(complaint({"empty", {}}) == "schema of empty: 0 buffers and images; right is 1 to 255");
}

TEST_CASE("schema: ints, packed words and voxels are compared by their bits and told by their place") {
    const Schema schema = checked(mixed_schema());
    Plain reference(schema, 0, {2000});
    Plain gpu(schema, 0, {2000});
    gpu.columns[1][1500] = 0xffffffffU;
    Comparison grains = compare(View(reference.view), View(gpu.view));
    CHECK(grains.differing(0) == 1);
    CHECK(grains[{0, 1}].compared == 2000);
    REQUIRE(grains.worst.size() == 1);
    CHECK(grains.worst[0].index == 1500);
    CHECK(grains.worst[0].gpu.integer() == -1);
    CHECK(grains.worst[0].ulp == 1);

    // A bit pattern that is NaN as a float is an ordinary uint.
    Plain voxels(schema, 2, {4, 3, 2});
    Plain others(schema, 2, {4, 3, 2});
    voxels.columns[0][23] = 0x7fc00000U;
    others.columns[0][23] = 0x7fc00001U;
    const Comparison volume = compare(View(voxels.view), View(others.view));
    CHECK(volume.differing(2) == 1);
    CHECK(volume[{2, 0}].nan == 0);
    CHECK(differing_items(View(voxels.view), View(others.view)) == std::vector<std::size_t>{23});
    CHECK(state_hash(View(voxels.view)) != state_hash(View(others.view)));

    grains.add(volume);
    CHECK(grains.resources.size() == 3);
    CHECK(grains.differing(1) == 0);
    CHECK(grains.worst.size() == 2);
}

TEST_CASE("schema: items that one side alone has differ") {
    const Schema schema = checked(mixed_schema());
    const Plain reference(schema, 0, {5});
    const Plain gpu(schema, 0, {3});
    const Comparison c = compare(View(reference.view), View(gpu.view));
    CHECK(c.differing(0) == 2);
    CHECK_FALSE(c.agree());
    CHECK(c.compared() == 3 * 4);
    CHECK(state_hash(View(reference.view)) != state_hash(View(gpu.view)));
    const Plain none(schema, 0, {0});
    CHECK(compare(View(none.view), View(none.view)).agree());
    CHECK(state_hash(View(none.view)) == 0);
}

TEST_CASE("schema: a view of particles hashes word by word as documented") {
    Particles particles;
    particles.resize(300);
    lockstep::Random random(7, 1);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const auto next = [&] { return static_cast<float>(random.symmetric()); };
        particles.set(i, {{next(), next(), next()}, {next(), next(), next()}, next(), next()});
    }
    const auto field = [&](std::uint64_t k, float (*component)(const ParticleState&, int), int n) {
        return hash_by_hand(k << 60U, words_of(particles, component, n));
    };
    CHECK(state_hash(particles) == field(
                                       1, [](const ParticleState& s, int c) { return s.position[c]; }, 3) +
                                       field(
                                           2, [](const ParticleState& s, int c) { return s.direction[c]; }, 3) +
                                       field(
                                           3, [](const ParticleState& s, int) { return s.speed; }, 1) +
                                       field(
                                           4, [](const ParticleState& s, int) { return s.collide_time; }, 1));
    const Plain voxels(collision_schema(), collision::cdt, {2, 2});
    CHECK(state_hash(View(voxels.view)) == hash_by_hand(0x5000000000000000U, voxels.columns[0]));
}

TEST_CASE("schema: values keep their kind, and floats are the same when both are NaN") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(same_bits(Value(nan), Value(-nan)));
    CHECK_FALSE(same_bits(Value(0.0F), Value(-0.0F)));
    CHECK_FALSE(same_bits(Value(0.0F), Value(Scalar::uint32, 0)));
    CHECK_FALSE(same_bits(Value(Scalar::uint32, 0x7fc00000U), Value(Scalar::uint32, 0x7fc00001U)));
    CHECK(distance(Value(Scalar::int32, 0x80000000U), Value(Scalar::int32, 0x7fffffffU)) == 0xffffffffLL);
    CHECK(distance(Value(0.0F), Value(-0.0F)) == 0);
}

} // namespace lockstep::test::schema_test
