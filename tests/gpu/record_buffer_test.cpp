#include <catch2/catch.hpp>

#include "gpu/check.hpp"
#include "gpu/record_buffer.hpp"
#include "gpu/shader_source.hpp"
#include "tests/gpu/any_context.hpp"
#include "tests/gpu/one_texel_target.hpp"
#include "tests/temporary_folder.hpp"

namespace lockstep::test::record_buffer_test {

using test::open_context;
using test::TemporaryFolder;

namespace {

/// A grain's position, whether it lives, and words that hold more: nothing typed knows them.
const Schema& grains() {
    static const Schema schema = checked({"grains",
                                          {{.name = "grains",
                                            .item = "grain",
                                            .title = "the grains",
                                            .fields = {{"position", Scalar::float32, 3, "world units"},
                                                       {"alive", Scalar::int32},
                                                       {"packed", Scalar::uint32, 2}}}}});
    return schema;
}

/// In another order than the schema's.
const RecordLayout layout{&grains(), 0, {{2, "Packed"}, {0, "Position"}, {1, "Alive"}}};

struct Grains {
    explicit Grains(std::size_t count) {
        view = {&grains(), 0, {count}, {}};
        std::uint32_t next = 1;
        for (const Field& field : grains().resources[0].fields) {
            std::vector<std::uint32_t>& words = columns.emplace_back();
            for (std::size_t i = 0; i < count * static_cast<std::size_t>(field.components); ++i)
                words.push_back(next = next * 1664525U + 1013904223U);
        }
        for (std::vector<std::uint32_t>& words : columns)
            view.columns.push_back(reinterpret_cast<std::byte*>(words.data()));
    }
    std::vector<std::vector<std::uint32_t>> columns;
    WritableView view;
};

} // namespace

TEST_CASE("record buffer: floats, ints and packed words come back bit for bit, whatever their order in a record") {
    const auto context = open_context();
    if (!context)
        return;
    CHECK(layout.bytes() == 24);
    const Grains original(10007);
    Grains read(10007);
    for (std::vector<std::uint32_t>& words : read.columns)
        words.assign(words.size(), 0);
    RecordBuffer buffer(layout, 10007);
    buffer.upload(original.view);
    buffer.read(read.view);
    CHECK(original.columns == read.columns);
    CHECK(buffer.holds(original.view));
    read.columns[1][10006] ^= 1U;
    CHECK_FALSE(buffer.holds(read.view));
    buffer.fill(0xca7ca7ca);
    buffer.read(read.view);
    CHECK(find_word(read.view, 0xca7ca7ca) == 0);
    CHECK(find_word(original.view, 0xca7ca7ca) == original.view.count());
    CHECK_THROWS_WITH(RecordBuffer(layout, std::size_t{1} << 56U),
                      "buffer of 72057594037927936 grains: GL_OUT_OF_MEMORY");
}

TEST_CASE("record buffer: integer attributes reach a shader as integers, and are captured as such") {
    const auto context = open_context();
    if (!context)
        return;
    const TemporaryFolder folder;
    folder.write("copy.vert", R"(#version 330 core
in vec3 a_Position;
in int a_Alive;
in uvec2 a_Packed;
out vec3 out_Position;
flat out int out_Alive;
flat out uvec2 out_Packed;
void main() {
    out_Position = a_Position;
    out_Alive = a_Alive;
    out_Packed = a_Packed;
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);
}
)");
    const Program program("copy", {{load_stage({folder.path()}, "copy", Stage::vertex)}}, layout.captures());
    Grains original(500);
    for (std::uint32_t& word : original.columns[0])
        word = 0x3f800000U + (word & 0xffffU); // no NaN, whose payload GL may change
    Grains read(500);
    RecordBuffer from(layout, 500), to(layout, 500);
    from.upload(original.view);
    to.fill(0);
    const GlVertexArray attributes = vertex_array(from, program);
    program.use();
    gl::BindVertexArray(attributes.id());
    to.bind_capture();
    const test::OneTexelTarget target;
    gl::Enable(GL_RASTERIZER_DISCARD);
    gl::BeginTransformFeedback(GL_POINTS);
    gl::DrawArrays(GL_POINTS, 0, 500);
    gl::EndTransformFeedback();
    gl::Disable(GL_RASTERIZER_DISCARD);
    to.read(read.view);
    CHECK(original.columns == read.columns);
    check_gl("copy");
}

} // namespace lockstep::test::record_buffer_test
