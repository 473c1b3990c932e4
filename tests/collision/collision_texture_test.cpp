#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include "gpu/check.hpp"
#include "gpu/collision/collision_texture.hpp"
#include "tests/gpu/any_context.hpp"

namespace lockstep::test::collision_texture_test {

using test::open_context;

namespace {

template <class Texel> bool same_bits(const Image<Texel>& a, const Image<Texel>& b) {
    return a.width == b.width && a.height == b.height && a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(Texel)) == 0;
}

/// Every component from `code(i)`, i counting up.
template <class Code> CollisionImage codes(int width, int height, const Code& code) {
    CollisionImage image(width, height);
    std::uint32_t i = 0;
    for (glm::vec4& texel : image.texels)
        for (int c = 0; c < 4; ++c)
            texel[c] = code(i++);
    return image;
}

bool survives(const CollisionImage& image, CdtFormat format) {
    CollisionTexture texture(image.width, image.height, format);
    texture.upload(image);
    CollisionImage read;
    texture.read(read);
    return same_bits(image, read);
}

} // namespace

TEST_CASE("collision texture: codes of every format survive upload and read-back") {
    for (const char* name : {"osmesa", "egl"}) {
        const auto context = open_context(name);
        if (!context)
            continue;
        // A multiplier scatters the floats over all exponents, NaN payloads and subnormals among them.
        CHECK(survives(codes(129, 67, [](std::uint32_t i) { return std::bit_cast<float>(i * 2654435761U); }),
                       CdtFormat::rgba32f));
        CHECK(survives(codes(1, 1, [](std::uint32_t) { return std::numeric_limits<float>::denorm_min(); }),
                       CdtFormat::rgba32f));
        // All halves but NaN, which is checked apart.
        CHECK(survives(codes(128, 128,
                             [](std::uint32_t i) {
                                 const float value = glm::unpackHalf1x16(static_cast<std::uint16_t>(i));
                                 return std::isnan(value) ? 1.0F : value;
                             }),
                       CdtFormat::rgba16f));
        CHECK(survives(codes(64, 1, [](std::uint32_t i) { return static_cast<float>(i); }), CdtFormat::rgba8));
    }
}

TEST_CASE("collision texture: a NaN in rgba16f stays one") {
    const auto context = open_context();
    if (!context)
        return;
    CollisionTexture texture(1, 1, CdtFormat::rgba16f);
    texture.upload(CollisionImage(1, 1, glm::vec4(std::numeric_limits<float>::quiet_NaN())));
    CollisionImage read;
    texture.read(read);
    CHECK(std::isnan(read.at(0, 0).x));
    CHECK(std::isnan(read.at(0, 0).w));
}

TEST_CASE("collision texture: clear makes every texel zero and depth one") {
    const auto context = open_context();
    if (!context)
        return;
    for (const CdtFormat format : {CdtFormat::rgba32f, CdtFormat::rgba16f, CdtFormat::rgba8}) {
        CollisionTexture texture(7, 5, format);
        CollisionImage read;
        texture.read(read);
        CHECK(same_bits(read, CollisionImage(7, 5)));
        texture.upload(CollisionImage(7, 5, glm::vec4(1.0F)));
        texture.clear();
        texture.read(read);
        CHECK(same_bits(read, CollisionImage(7, 5)));
        DepthImage depth;
        texture.read(depth);
        CHECK(same_bits(depth, DepthImage(7, 5, 1.0F)));
    }
}

TEST_CASE("collision texture: row 0 is the bottom row") {
    const auto context = open_context();
    if (!context)
        return;
    CollisionTexture texture(3, 2, CdtFormat::rgba32f);
    texture.bind_target();
    gl::Enable(GL_SCISSOR_TEST);
    gl::Scissor(2, 0, 1, 1);
    const float value[4] = {0.5F, 0.25F, 0.125F, 1.0F};
    gl::ClearBufferfv(GL_COLOR, 0, value);
    gl::Disable(GL_SCISSOR_TEST);
    CollisionImage read;
    texture.read(read);
    CollisionImage expected(3, 2);
    expected.at(2, 0) = {0.5F, 0.25F, 0.125F, 1.0F};
    CHECK(same_bits(read, expected));
    CollisionTexture copy(3, 2, CdtFormat::rgba32f);
    copy.upload(expected);
    copy.read(read);
    CHECK(same_bits(read, expected));
}

TEST_CASE("collision texture: a size GL does not allow is told with what it does") {
    const auto context = open_context();
    if (!context)
        return;
    const int limit = context->describe().max_texture_size;
    const auto told = [&](int width, int height) {
        return fmt::format("CDT of {} x {} texels: this GL allows 1 to {} a side", width, height, limit);
    };
    CHECK_THROWS_WITH(CollisionTexture(limit + 1, 1, CdtFormat::rgba8), told(limit + 1, 1));
    CHECK_THROWS_WITH(CollisionTexture(1, 0, CdtFormat::rgba8), told(1, 0));
}

} // namespace lockstep::test::collision_texture_test
