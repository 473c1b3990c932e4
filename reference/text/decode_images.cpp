#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "reference/text/decoder.hpp"

namespace lockstep::text {

void Decoder::image(const Variable& variable) {
    const bool is_array = type(variable.type).kind == Type::Kind::array;
    const Type& of = type(is_array ? type(variable.type).element : variable.type);
    const std::string& name = module_.ids[variable.id].name;
    static constexpr std::array known{spv::Dim1D, spv::Dim2D, spv::Dim3D, spv::DimCube, spv::DimBuffer};
    if (std::find(known.begin(), known.end(), of.shape.dimensions) == known.end() || of.shape.axes() > 3)
        refuse(
            fmt::format("image {} is not interpreted; expected one of 1, 2 or 3 dimensions, a cube or a buffer, whose "
                        "texels have at most 3 numbers with those of layers and samples",
                        name));
    const std::uint32_t count = is_array ? bindings_of(variable) : 1, first = take_cells(count);
    address_[variable.id] = {.place = first, .type = variable.type};
    const bool is_sampler = of.kind == Type::Kind::sampled_image;
    for (std::uint32_t i = 0; i < count; ++i) {
        p_.constants.push_back({first + i, static_cast<std::uint32_t>(p_.images.size()), false});
        p_.images.push_back({is_array ? fmt::format("{}[{}]", name, i) : name, !is_sampler && of.is_storage, of.shape,
                             is_real(of.element), type(of.element).is_signed, module_.ids[variable.id].is_coherent,
                             binding(variable, i)});
    }
}

/// The place of a texelFetch with an offset (GLSL 4.60, 8.9.3); an arrayed image's layer stays.
std::uint32_t Decoder::moved_place(std::uint32_t place, std::uint32_t axes, std::uint32_t offset, std::uint32_t moved) {
    const std::uint32_t out = take_cells(axes);
    copy(out, place, axes);
    Step& sum = add(static_cast<std::uint16_t>(spv::OpIAdd));
    sum.out = out;
    sum.a = place;
    sum.b = offset;
    sum.n = static_cast<std::uint16_t>(moved);
    return out;
}

/// A texel's place with its sample behind it.
std::uint32_t Decoder::place_of_sample(std::uint32_t place, std::uint32_t axes, std::uint32_t sample) {
    const std::uint32_t out = take_cells(axes);
    copy(out, place, axes - 1);
    copy(out + axes - 1, sample, 1);
    return out;
}

/// n numbers divided by one (GLSL 4.60, 8.9.2).
std::uint32_t Decoder::projected(std::uint32_t numbers, std::uint32_t n, std::uint32_t by) {
    const std::uint32_t out = take_cells(n);
    for (std::uint32_t c = 0; c < n; ++c) {
        Step& quotient = add(static_cast<std::uint16_t>(spv::OpFDiv));
        quotient.out = out + c;
        quotient.a = numbers + c;
        quotient.b = by;
        quotient.n = 1;
    }
    return out;
}

/// 1 where a reference is no further than the texel, else 0: GL's first comparison (GL 4.6, 8.23.1).
void Decoder::compared_texel(std::uint32_t out, std::uint32_t reference, std::uint32_t texel) {
    const std::uint32_t is_nearer = take_cells(1);
    Step& compare = add(static_cast<std::uint16_t>(spv::OpFOrdLessThanEqual));
    compare.out = is_nearer;
    compare.n = 1;
    compare.a = reference;
    compare.b = texel;
    Step& number = add(static_cast<std::uint16_t>(spv::OpConvertUToF));
    number.out = out;
    number.n = 1;
    number.a = is_nearer;
}

Decoder::ImageOperands Decoder::image_operands(Words w, std::size_t from) {
    ImageOperands all;
    all.mask = w.size() > from ? w[from] : 0;
    std::size_t next = from + 1;
    const auto take = [&](std::uint32_t bit, std::size_t words) {
        const std::uint32_t first = (all.mask & bit) != 0 && next < w.size() ? w[next] : 0;
        next += (all.mask & bit) != 0 ? words : 0;
        return first;
    };
    take(spv::ImageOperandsBiasMask, 1);
    all.level = take(spv::ImageOperandsLodMask, 1);
    take(spv::ImageOperandsGradMask, 2);
    all.offset = take(spv::ImageOperandsConstOffsetMask, 1) + take(spv::ImageOperandsOffsetMask, 1);
    take(spv::ImageOperandsConstOffsetsMask, 1);
    all.sample = take(spv::ImageOperandsSampleMask, 1);
    return all;
}

/// Among levels there is no choice: there is one.
void Decoder::sample_image(const Instruction& at) {
    const Words w = at.words;
    const bool is_compared = at.op == spv::OpImageSampleDrefImplicitLod || at.op == spv::OpImageSampleDrefExplicitLod ||
                             at.op == spv::OpImageSampleProjDrefImplicitLod ||
                             at.op == spv::OpImageSampleProjDrefExplicitLod,
               is_projected =
                   at.op >= spv::OpImageSampleProjImplicitLod && at.op <= spv::OpImageSampleProjDrefExplicitLod;
    const ImageOperands given = image_operands(w, is_compared ? 5 : 4);
    const std::uint32_t allowed = spv::ImageOperandsBiasMask | spv::ImageOperandsLodMask | spv::ImageOperandsGradMask |
                                  spv::ImageOperandsConstOffsetMask | spv::ImageOperandsOffsetMask;
    if ((given.mask & ~allowed) != 0)
        refuse(fmt::format("image operands {:#x} are not interpreted", given.mask & ~allowed));
    const std::uint32_t axes = module_.type_of(w[2]).shape.axes(), image = cell(w[2]), given_place = cell(w[3]),
                        offset = given.offset == 0 ? none : cell(given.offset);
    const auto divided = [&](std::uint32_t numbers, std::uint32_t n) { // by the number behind the place
        return is_projected ? projected(numbers, n, given_place + axes) : numbers;
    };
    const std::uint32_t place = divided(given_place, axes), reference = is_compared ? divided(cell(w[4]), 1) : 0,
                        out = cell(w[1]), texel = is_compared ? take_cells(1) : out;
    Step& step = is_compared ? add(code::sample_texel) : made(code::sample_texel, w);
    step.out = texel;
    step.n = static_cast<std::uint16_t>(type(w[0]).cells);
    step.a = image;
    step.b = place;
    step.c = axes;
    step.d = offset;
    if (is_compared)
        compared_texel(out, reference, texel);
}

/// imageLoad and texelFetch.
void Decoder::read_image(const Instruction& at) {
    const Words w = at.words;
    const ImageOperands given = image_operands(w, 4);
    const std::uint32_t allowed = spv::ImageOperandsLodMask | spv::ImageOperandsConstOffsetMask |
                                  spv::ImageOperandsOffsetMask | spv::ImageOperandsSampleMask;
    if ((given.mask & ~allowed) != 0)
        refuse(fmt::format("image operands {:#x} are not interpreted", given.mask & ~allowed));
    const std::uint32_t axes = module_.type_of(w[2]).shape.axes(), image = cell(w[2]),
                        level = given.level == 0 ? word_cell(0) : cell(given.level);
    std::uint32_t place = cell(w[3]);
    if (given.sample != 0)
        place = place_of_sample(place, axes, cell(given.sample));
    if (given.offset != 0)
        place = moved_place(place, axes, cell(given.offset), module_.type_of(given.offset).cells);
    Step& step = made(at.op == spv::OpImageRead ? code::load_texel : code::fetch_texel, w);
    step.a = image;
    step.b = place;
    step.c = axes;
    step.d = level;
}

void Decoder::write_image(const Instruction& at) {
    const Words w = at.words;
    const ImageOperands given = image_operands(w, 3);
    if ((given.mask & ~std::uint32_t{spv::ImageOperandsSampleMask}) != 0)
        refuse(fmt::format("image operands {:#x} are not interpreted", given.mask));
    const std::uint32_t axes = module_.type_of(w[0]).shape.axes(), image = cell(w[0]), texel = cell(w[2]);
    std::uint32_t place = cell(w[1]);
    if (given.sample != 0)
        place = place_of_sample(place, axes, cell(given.sample));
    Step& step = add(code::store_texel);
    step.n = static_cast<std::uint16_t>(module_.type_of(w[2]).cells);
    step.a = image;
    step.b = place;
    step.c = texel;
    step.d = axes;
}

/// Images (SPIR-V 3.42.10). Returns false for other instructions.
bool Decoder::image_operation(const Instruction& at) {
    const Words w = at.words;
    switch (at.op) {
    case spv::OpSampledImage:
    case spv::OpImage:
        cell_[w[1]] = cell(w[2]);
        return true;
    case spv::OpImageFetch:
    case spv::OpImageRead:
        read_image(at);
        return true;
    case spv::OpImageSampleExplicitLod:
    case spv::OpImageSampleImplicitLod:
    case spv::OpImageSampleDrefExplicitLod:
    case spv::OpImageSampleDrefImplicitLod:
    case spv::OpImageSampleProjExplicitLod:
    case spv::OpImageSampleProjImplicitLod:
    case spv::OpImageSampleProjDrefExplicitLod:
    case spv::OpImageSampleProjDrefImplicitLod:
        sample_image(at);
        return true;
    case spv::OpImageWrite:
        write_image(at);
        return true;
    case spv::OpImageQuerySizeLod:
    case spv::OpImageQuerySize: {
        const std::uint32_t a = cell(w[2]);
        made(code::image_size, w).a = a;
        return true;
    }
    case spv::OpImageQuerySamples: { // the last of its numbers
        const ImageShape& shape = module_.type_of(w[2]).shape;
        const std::uint32_t a = cell(w[2]), all = take_cells(shape.axes());
        Step& step = add(code::image_size);
        step.out = all;
        step.n = static_cast<std::uint16_t>(shape.axes());
        step.a = a;
        cell_[w[1]] = all + shape.axes() - 1;
        return true;
    }
    case spv::OpImageQueryLevels: {
        const std::uint32_t a = cell(w[2]);
        made(code::query_levels, w).a = a;
        return true;
    }
    default:
        return false;
    }
}

} // namespace lockstep::text
