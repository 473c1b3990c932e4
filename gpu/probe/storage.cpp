#include <bit>
#include <cmath>

#include <glm/gtc/packing.hpp>

#include "gpu/probe/compute_stage.hpp"
#include "gpu/probe/half_grid.hpp"
#include "gpu/probe/image_stage.hpp"
#include "gpu/probe/inputs.hpp"
#include "gpu/probe/rows.hpp"
#include "gpu/probe/vertex_stage.hpp"

namespace lockstep::probing {
namespace {

constexpr int storage_side = 64;
constexpr std::size_t storage_components = storage_side * storage_side * 4;

template <class Stored>
std::vector<Stored> stored(const ImageStage& store, const TexelLayout& layout, const Floats& x) {
    const GlTexture source = make_texture(rgba32f, storage_side, storage_side, x.data());
    const GlTexture target = make_texture(layout, storage_side, storage_side, nullptr);
    const GlTexture* sources[] = {&source};
    const GlTexture* targets[] = {&target};
    store.run(storage_side, storage_side, sources, targets);
    return read_texture<Stored>(target, layout, storage_components);
}

Floats halves(const std::vector<std::uint16_t>& codes) {
    Floats values;
    for (const std::uint16_t half : codes)
        values.push_back(glm::unpackHalf1x16(half));
    return values;
}

/// Random values with every other one halfway between two neighbours of the grid.
Floats halves_and_ties(Range range, std::uint64_t seed) {
    Floats values = random_floats(storage_components, seed, range);
    for (std::size_t i = 0; i < values.size(); i += 2)
        values[i] =
            on_half_grid(values[i], toward_zero) +
            std::copysign(static_cast<float>(std::ldexp(0.5, std::max(std::ilogb(values[i]), -14) - 10)), values[i]);
    return values;
}

/// `store`: what becomes of as many floats. Rows are named after `prefix`.
template <class Store> void measure_half_store(const std::string& prefix, const Store& store, Rows& rows) {
    const Floats normal = halves_and_ties({-14, 15, true}, 31);
    rows.push_back(judge(prefix + " to half", store(normal),
                         {{"nearest even", each(normal, [](float x) { return on_half_grid(x, nearest_even); })},
                          {"nearest away", each(normal, [](float x) { return on_half_grid(x, nearest_away); })},
                          {"truncate", each(normal, [](float x) { return on_half_grid(x, toward_zero); })}}));
    const Floats tiny = halves_and_ties({-23, -14, true}, 32);
    rows.push_back(judge(prefix + " to subnormal half", store(tiny),
                         {{"nearest even", each(tiny, [](float x) { return on_half_grid(x, nearest_even); })},
                          {"nearest away", each(tiny, [](float x) { return on_half_grid(x, nearest_away); })},
                          {"truncate", each(tiny, [](float x) { return on_half_grid(x, toward_zero); })},
                          {"flushed", each(tiny, [](float x) { return std::copysign(0.0F, x); })}}));
    const Floats large = random_floats(storage_components, 33, {16, 40, true});
    rows.push_back(judge(prefix + " above the largest half", store(large),
                         {{"infinite", each(large, [](float x) { return std::copysign(HUGE_VALF, x); })},
                          {"largest", each(large, [](float x) { return std::copysign(65504.0F, x); })}}));
}

/// From below 0 to above 1, every other one next to a value halfway between two codes.
Floats unit_values() {
    Floats values = random_floats(storage_components, 34, {-10, 1, false});
    for (std::size_t i = 0; i < values.size(); i += 2) {
        const float tie = (static_cast<float>(i / 2 % 255) + 0.5F) / 255.0F;
        const auto step = static_cast<std::uint32_t>(i / 512 % 9) - 4U;
        values[i] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(tie) + step);
    }
    return values;
}

void measure_unorm_store(const ImageStage& store, Rows& rows) {
    const Floats x = unit_values();
    Floats codes;
    for (const std::uint8_t code : stored<std::uint8_t>(store, rgba8, x))
        codes.push_back(static_cast<float>(code));
    const auto clamped = [](float v) { return v > 0.0F ? (v < 1.0F ? v : 1.0F) : 0.0F; };
    rows.push_back(
        judge("float to unorm8", codes,
              {{"nearest", each(x, [&](float v) { return static_cast<float>(std::nearbyint(255.0 * clamped(v))); })},
               {"rint(x*255)", each(x, [&](float v) { return std::nearbyint(clamped(v) * 255.0F); })},
               {"floor(x*255+0.5)", each(x, [&](float v) { return std::floor(clamped(v) * 255.0F + 0.5F); })},
               {"truncate", each(x, [&](float v) { return std::trunc(clamped(v) * 255.0F); })}}));
}

Floats fetched(const VertexStage& fetch, const GlTexture& texture, const std::vector<glm::vec2>& where) {
    gl::ActiveTexture(GL_TEXTURE0);
    gl::BindTexture(GL_TEXTURE_2D, texture.id());
    return fetch.run(where.size(), {{"a_Texel", 2, &where.front().x}}, "out_Texel");
}

std::vector<glm::vec2> every_texel(int width, int height) {
    std::vector<glm::vec2> where;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            where.emplace_back(x, y);
    return where;
}

void measure_loads(const VertexStage& fetch, Rows& rows) {
    std::vector<std::uint8_t> codes(256);
    Floats code_values(256);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        codes[i] = static_cast<std::uint8_t>(i);
        code_values[i] = static_cast<float>(i);
    }
    rows.push_back(judge("unorm8 to float", fetched(fetch, make_texture(rgba8, 8, 8, codes.data()), every_texel(8, 8)),
                         {{"c/255", each(code_values, [](float c) { return c / 255.0F; })},
                          {"c*(1/255)", each(code_values, [](float c) { return c * (1.0F / 255.0F); })}}));

    // Every finite half of one sign.
    std::vector<std::uint16_t> halves(0x7c00);
    Floats half_values;
    for (std::size_t i = 0; i < halves.size(); ++i) {
        halves[i] = static_cast<std::uint16_t>(i);
        half_values.push_back(glm::unpackHalf1x16(halves[i]));
    }
    rows.push_back(judge(
        "half to float",
        fetched(fetch, make_texture(rgba16f, 0x7c00 / 4 / 64, 64, halves.data()), every_texel(0x7c00 / 4 / 64, 64)),
        {{"exact", half_values},
         {"subnormals flushed", each(half_values, [](float x) { return x < 0x1p-14F ? 0.0F : x; })}}));
}

/// Undefined in GL; the passes never do it. A foreign shader may.
void measure_outside(const VertexStage& fetch, Rows& rows) {
    constexpr int size = 8;
    Floats texels;
    for (int i = 0; i < size * size * 4; ++i)
        texels.push_back(static_cast<float>(i + 1));
    const std::vector<glm::vec2> where{{-1, 3}, {8, 3}, {3, -1}, {3, 8}, {-1, -1}, {8, 8}, {-100, 3}, {1000, 1000}};
    Floats edge, repeated, zero_alpha_one;
    for (const glm::vec2& at : where)
        for (int c = 0; c < 4; ++c) {
            const auto x = static_cast<int>(at.x);
            const auto y = static_cast<int>(at.y);
            const auto texel = [&](int column, int row) {
                return texels[static_cast<std::size_t>((row * size + column) * 4 + c)];
            };
            edge.push_back(texel(std::clamp(x, 0, size - 1), std::clamp(y, 0, size - 1)));
            repeated.push_back(texel(x & (size - 1), y & (size - 1)));
            zero_alpha_one.push_back(c == 3 ? 1.0F : 0.0F);
        }
    rows.push_back(judge("texelFetch outside", fetched(fetch, make_texture(rgba32f, size, size, texels.data()), where),
                         {{"zero", Floats(where.size() * 4, 0.0F)},
                          {"zero, alpha 1", zero_alpha_one},
                          {"nearest texel", edge},
                          {"repeated", repeated}}));
}

} // namespace

void measure_storage(Rows& rows) {
    const ImageStage store("probe/store");
    measure_half_store(
        "float", [&](const Floats& x) { return halves(stored<std::uint16_t>(store, rgba16f, x)); }, rows);
    measure_unorm_store(store, rows);
    const VertexStage fetch("probe/fetch", {}, {{"a_Texel", 2}}, {{"out_Texel", GL_FLOAT_VEC4}});
    measure_loads(fetch, rows);
    measure_outside(fetch, rows);
}

void measure_image_store(Rows& rows) {
    const ComputeStage store("probe/store");
    const auto stored_by_image = [&](const Floats& x) {
        const GlTexture target = make_texture(rgba16f, storage_side, storage_side, nullptr);
        gl::BindImageTexture(0, target.id(), 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA16F);
        store.program().set_unit("u_Target", 0, GL_IMAGE_2D);
        static_cast<void>(store.run(x, 1, storage_components / 4));
        gl::MemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
        return halves(read_texture<std::uint16_t>(target, rgba16f, storage_components));
    };
    measure_half_store("image: store", stored_by_image, rows);
}

} // namespace lockstep::probing
