#include "reference/text/memory.hpp"

#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "reference/half.hpp"

namespace lockstep::text {
namespace {

constexpr std::string_view bounds_rule = "access outside of a buffer (GLSL 4.60, 5.11)";

/// The nearest code; ties go to the even one, as drivers measured do (GL 4.6, 2.3.5.2 leaves them open).
std::uint32_t unorm8(float x) {
    constexpr float most = 255.0F;
    return x > 0.0F ? static_cast<std::uint32_t>(std::nearbyint(std::fmin(x, 1.0F) * most)) : 0U;
}

} // namespace

bool is_inside(const TexelMemory& image, const std::array<std::int32_t, 3>& at) {
    for (std::size_t c = 0; c < at.size(); ++c)
        if (at[c] < 0 || static_cast<std::uint32_t>(at[c]) >= image.size[c])
            return false;
    return true;
}

std::size_t first_word(const TexelMemory& image, const std::array<std::int32_t, 3>& at) {
    const std::size_t row = static_cast<std::size_t>(at[2]) * image.size[1] + static_cast<std::size_t>(at[1]);
    return (row * image.size[0] + static_cast<std::size_t>(at[0])) * image.components;
}

Memory::Memory(const Program& program, const Bindings& bindings, Findings& findings, Races* races, Writers* writers)
    : program_(program), bindings_(bindings), findings_(findings), races_(races), writers_(writers),
      shared_(program.shared), unset_(races != nullptr ? program.shared : 0) {
    if (writers != nullptr) {
        for (const std::span<std::uint32_t>& words : bindings.blocks)
            writers->blocks.emplace_back(words.size());
        for (const TexelMemory& image : bindings.images)
            writers->images.emplace_back(image.words.size());
    }
    for (const std::span<std::uint32_t>& words : bindings.blocks)
        buffer_of_.push_back(static_cast<std::uint32_t>(
            std::ranges::find(bindings.blocks, words.data(), [](const auto& one) { return one.data(); }) -
            bindings.blocks.begin()));
    for (const TexelMemory& image : bindings.images)
        image_of_.push_back(static_cast<std::uint32_t>(
            std::ranges::find(bindings.images, image.words.data(), [](const auto& one) { return one.words.data(); }) -
            bindings.images.begin()));
}

std::uint32_t Memory::outside_block(std::uint32_t block, std::uint32_t word, Place by) {
    findings_.add(bounds_rule, by, [&] {
        return fmt::format("word {} of {}, which has {}", word, program_.blocks[block].name,
                           bindings_.blocks[block].size());
    });
    return 0;
}

std::uint32_t Memory::outside_shared(Place by) {
    findings_.add(bounds_rule, by, [] { return "a shared variable beyond its end"; });
    return 0;
}

void Memory::note_index(std::uint32_t index, std::uint32_t count, Place by) {
    if (races_ != nullptr)
        outside_.insert(std::uint64_t{by.line} << 32U | by.invocation);
    findings_.add("index out of bounds (GLSL 4.60, 5.11)", by,
                  [&] { return fmt::format("index {} of {} elements", static_cast<std::int32_t>(index), count); });
}

std::uint32_t Memory::length(std::uint32_t block) const {
    const Block& about = program_.blocks[block];
    const std::size_t bytes = bindings_.blocks[block].size() * word_bytes;
    if (about.array_stride == 0 || bytes < about.array_offset)
        return 0;
    return static_cast<std::uint32_t>((bytes - about.array_offset) / about.array_stride);
}

void Memory::touch_texel(std::uint32_t number, const std::array<std::int32_t, 3>& at, Races::How how, Place by) {
    const TexelMemory& image = bindings_.images[number];
    if (races_ == nullptr || !program_.images[number].is_storage || !is_inside(image, at))
        return;
    note_read(how, by);
    races_->touch(Races::Space::image, image_of_[number], static_cast<std::uint32_t>(first_word(image, at)), how, by,
                  image.name, program_.images[number].is_coherent);
}

Memory::Texel Memory::texel_words(std::uint32_t number, const std::array<std::int32_t, 3>& at) const {
    const TexelMemory& image = bindings_.images[number];
    if (!is_inside(image, at))
        return {};
    const bool is_real = program_.images[number].is_real;
    Texel texel{0, 0, 0, is_real ? std::bit_cast<std::uint32_t>(1.0F) : 1U};
    const std::size_t first = first_word(image, at);
    for (std::uint32_t c = 0; c < image.components; ++c) {
        texel[c] = image.words[first + c];
        if (image.code == TexelMemory::Code::unorm8)
            texel[c] = std::bit_cast<std::uint32_t>(static_cast<float>(texel[c]) / 255.0F);
    }
    return texel;
}

Memory::Texel Memory::load_texel(std::uint32_t number, const std::array<std::int32_t, 3>& at,
                                 std::optional<std::int32_t> fetched, Place by) {
    const TexelMemory& image = bindings_.images[number];
    if (fetched && *fetched != 0)
        findings_.add("texelFetch of a level that the image does not have (GL 4.6, 11.1.3.2)", by,
                      [&] { return fmt::format("level {} of {}, which has level 0 alone", *fetched, image.name); });
    else if (fetched && !is_inside(image, at))
        findings_.add("texelFetch outside of the image (GL 4.6, 11.1.3.2)", by,
                      [&] { return fmt::format("texel ({}, {}, {}) of {}", at[0], at[1], at[2], image.name); });
    touch_texel(number, at, Races::How::read, by);
    return texel_words(number, at);
}

Memory::Texel Memory::texel_at_edge(std::uint32_t number, std::array<std::int32_t, 3> at) const {
    const TexelMemory& image = bindings_.images[number];
    if (!is_inside(image, at) && image.filter == TexelMemory::Filter::linear_in_black)
        return {};
    for (std::size_t c = 0; c < at.size(); ++c)
        at[c] = std::clamp(at[c], 0, static_cast<std::int32_t>(image.size[c]) - 1);
    return texel_words(number, at);
}

namespace {

/// The face of a cube that a direction shows to, and the place on it (GL 4.6, table 8.19).
std::array<float, 3> place_on_cube(const std::array<float, 3>& direction) {
    const auto [x, y, z] = direction;
    const float ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
    const bool is_x = ax >= ay && ax >= az, is_y = !is_x && ay >= az;
    const float across = is_x                ? (x < 0.0F ? z : -z)
                         : is_y || z >= 0.0F ? x
                                             : -x,
                up = is_y ? (y < 0.0F ? -z : z) : -y,
                most = is_x   ? ax
                       : is_y ? ay
                              : az;
    const float first = is_x ? 0.0F : is_y ? 2.0F : 4.0F;
    return {0.5F * (across / most + 1.0F), 0.5F * (up / most + 1.0F),
            first + ((is_x   ? x
                      : is_y ? y
                             : z) < 0.0F
                         ? 1.0F
                         : 0.0F)};
}

} // namespace

Memory::Texel Memory::sample(std::uint32_t number, std::array<float, 3> place, std::uint32_t axes,
                             const std::array<std::int32_t, 3>& moved) {
    const TexelMemory& image = bindings_.images[number];
    const bool is_linear = image.filter != TexelMemory::Filter::nearest;
    std::array<std::int32_t, 3> base{};
    const ImageShape& shape = program_.images[number].shape;
    if (shape.dimensions == spv::DimCube)
        place = place_on_cube(place);
    if (shape.is_arrayed || shape.dimensions == spv::DimCube) { // the nearest layer (GL 4.6, 8.14)
        const float layer = std::floor(place[--axes] + 0.5F), last = static_cast<float>(image.size[axes]) - 1.0F;
        base[axes] = std::isnan(layer) ? 0 : static_cast<std::int32_t>(std::clamp(layer, 0.0F, last));
    }
    std::array<float, 3> behind{};
    for (std::uint32_t axis = 0; axis < axes; ++axis) {
        const auto size = static_cast<float>(image.size[axis]);
        const float t = place[axis] * size - (is_linear ? 0.5F : 0.0F), floor = std::floor(t),
                    whole = floor + static_cast<float>(moved[axis]);
        behind[axis] = t - floor;
        base[axis] = std::isnan(whole) ? -1 : static_cast<std::int32_t>(std::clamp(whole, -1.0F, size));
    }
    if (!is_linear)
        return texel_at_edge(number, base);
    std::array<Texel, 8> cell{};
    const std::uint32_t corners = 1U << axes;
    for (std::uint32_t k = 0; k < corners; ++k) {
        std::array<std::int32_t, 3> at = base;
        for (std::uint32_t axis = 0; axis < axes; ++axis)
            at[axis] += static_cast<std::int32_t>(k >> axis & 1U);
        cell[k] = texel_at_edge(number, at);
    }
    for (std::uint32_t axis = 0, left = corners / 2; axis < axes; ++axis, left /= 2)
        for (std::uint32_t k = 0; k < left; ++k)
            for (std::size_t c = 0; c < cell[k].size(); ++c) {
                const auto a = std::bit_cast<float>(cell[2 * k][c]), b = std::bit_cast<float>(cell[2 * k + 1][c]);
                cell[k][c] = std::bit_cast<std::uint32_t>(std::fma(behind[axis], b - a, a));
            }
    return cell[0];
}

void Memory::put_texel(std::uint32_t number, const std::array<std::int32_t, 3>& at, const Texel& texel) {
    const TexelMemory& image = bindings_.images[number];
    if (!is_inside(image, at)) // no error, and no write (GL 4.6, 8.26)
        return;
    const std::size_t first = first_word(image, at);
    for (std::uint32_t c = 0; c < image.components; ++c) {
        const auto real = std::bit_cast<float>(texel[c]);
        put(image.words[first + c], image.code == TexelMemory::Code::unorm8 ? unorm8(real)
                                    : image.code == TexelMemory::Code::half
                                        ? std::bit_cast<std::uint32_t>(half_nearest(real))
                                        : texel[c]);
    }
}

void Memory::store_texel(std::uint32_t number, const std::array<std::int32_t, 3>& at, const Texel& texel, Place by) {
    touch_texel(number, at, Races::How::write, by);
    put_texel(number, at, texel);
    const TexelMemory& image = bindings_.images[number];
    if (writers_ == nullptr || !is_inside(image, at))
        return;
    for (std::uint32_t c = 0; c < image.components; ++c)
        note_write({WrittenPlace::Space::texel, number, first_word(image, at) + c}, by);
    std::fill_n(writers_->images[image_of_[number]].begin() + static_cast<std::ptrdiff_t>(first_word(image, at)),
                image.components, by.invocation + 1);
}

} // namespace lockstep::text
