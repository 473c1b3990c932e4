#include <catch2/catch.hpp>

#include <numeric>

#include "reference/model/error.hpp"
#include "tests/text/text_stage.hpp"

namespace lockstep::test::written_stages_test {

namespace {

using Words = std::vector<std::uint32_t>;
using Floats = std::vector<float>;
using Lines = std::vector<std::string>;

template <class Work> std::string refusal(const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// Numbers first, first + 1, ...
Floats counted(std::size_t n, float first = 0.0F) {
    Floats all(n);
    std::iota(all.begin(), all.end(), first);
    return all;
}

} // namespace

TEST_CASE("text stages: a vertex stage makes outputs of each vertex from its attributes and built-in variables") {
    TextStage stage(Stage::vertex, R"(
        in vec3 a_Place;
        in mat2 a_Turn;
        in ivec2 a_Code;
        uniform float u_Scale;
        struct Surface { vec2 turned; float weights[2]; };
        out Surface v_Surface;
        out Shown { vec4 colour; flat int code; } shown;
        out vec3 v_List[2];
        flat out uint v_Number;
        void main() {
            v_Surface.turned = a_Turn * a_Place.xy;
            v_Surface.weights[gl_VertexID % 2] = 1.0;
            v_Surface.weights[(gl_VertexID + 1) % 2] = 2.0;
            shown.colour = vec4(a_Place, u_Scale);
            shown.code = a_Code.x - a_Code.y;
            for (int i = 0; i < 2; ++i)
                v_List[i] = a_Place * float(i + 1);
            v_Number = uint(gl_VertexID * 10 + gl_InstanceID);
            gl_Position = vec4(a_Place * u_Scale, 1.0);
            gl_PointSize = 3.0;
            if (gl_VertexID == 4)
                return;
            gl_Position.w = 2.0;
        })");
    constexpr std::uint32_t count = 40;
    stage.uniforms["u_Scale"] = words_of(Floats{2.0F});
    stage.inputs["a_Place"] = words_of(counted(std::size_t{3} * count));
    stage.inputs["a_Turn"] = words_of(Floats{0.0F, 1.0F, -1.0F, 0.0F}); // the same for all
    for (std::uint32_t i = 0; i < count; ++i)
        stage.inputs["a_Code"].insert(stage.inputs["a_Code"].end(), {i, 2 * i});
    stage.inputs["gl_InstanceID"] = {7};
    const text::StageResult made = stage.run(count);
    const auto floats = [&](const char* name) { return floats_of(made.outputs.at(name)); };
    CHECK(made.vertices == count);
    for (std::uint32_t i = 0; i < count; ++i) {
        INFO("vertex " << i);
        const auto x = static_cast<float>(3 * i);
        const auto part = [&](const char* name, std::size_t n) {
            const Floats all = floats(name);
            REQUIRE(all.size() == n * count);
            return Floats(all.begin() + static_cast<std::ptrdiff_t>(n * i),
                          all.begin() + static_cast<std::ptrdiff_t>(n * (i + 1)));
        };
        CHECK(part("v_Surface.turned", 2) == Floats{-(x + 1.0F), x});
        CHECK(part("v_Surface.weights", 2) == (i % 2 == 0 ? Floats{1.0F, 2.0F} : Floats{2.0F, 1.0F}));
        CHECK(part("Shown.colour", 4) == Floats{x, x + 1.0F, x + 2.0F, 2.0F});
        CHECK(made.outputs.at("Shown.code")[i] == 0U - i);
        CHECK(part("v_List", 6) == Floats{x, x + 1.0F, x + 2.0F, 2.0F * x, 2.0F * (x + 1.0F), 2.0F * (x + 2.0F)});
        CHECK(made.outputs.at("v_Number")[i] == i * 10 + 7);
        CHECK(part("gl_Position", 4) == Floats{2.0F * x, 2.0F * (x + 1.0F), 2.0F * (x + 2.0F), i == 4 ? 1.0F : 2.0F});
        CHECK(part("gl_PointSize", 1) == Floats{3.0F});
    }
}

TEST_CASE("text stages: what a vertex stage is given has to be what it takes") {
    TextStage stage(Stage::vertex, "in vec2 a_Place;\nvoid main() { gl_Position = vec4(a_Place, 0.0, 1.0); }\n");
    CHECK(refusal([&] { stage.run(3); }) == "input a_Place of the stage is not given");
    stage.inputs["a_Place"] = Words(5);
    CHECK(refusal([&] { stage.run(3); }) == "input a_Place: expected 2 words, or 6 for 3 invocations, got 5");
    stage.inputs["a_Place"] = Words(6);
    stage.inputs["a_Plane"] = Words(6);
    CHECK(refusal([&] { stage.run(3); }) == "input a_Plane: the stage has no such input; it has a_Place, gl_VertexID, "
                                            "gl_InstanceID; did you mean a_Place?");
    CHECK(refusal([] {
              TextStage(Stage::geometry, "layout(points) in; layout(points, max_vertices = 1) out;\n"
                                         "layout(stream = 1) out float v_Part;\nvoid main() {\n"
                                         "v_Part = 1.0; EmitStreamVertex(1); }\n");
          }) == ("shader stage:4: several streams of vertices are not interpreted"));
}

TEST_CASE("text stages: a fragment stage makes colours and depth, and says what was discarded") {
    TextStage stage(Stage::fragment, R"(
        in vec2 v_Place;
        flat in int v_Kind;
        layout(location = 0) out vec4 o_Colour;
        layout(location = 1) out uint o_Code;
        bool is_kept() { if (v_Kind == 3) discard; return v_Kind != 5; }
        void main() {
            o_Colour = vec4(0.0);
            o_Code = 9u;
            gl_FragDepth = 0.25;
            if (!is_kept())
                return;
            o_Colour = vec4(v_Place, gl_FragCoord.x, gl_FrontFacing ? gl_PointCoord.x : gl_PointCoord.y);
            o_Code = uint(v_Kind);
            gl_FragDepth = gl_FragCoord.z * 0.5;
        })");
    constexpr std::uint32_t count = 20;
    for (std::uint32_t i = 0; i < count; ++i) {
        stage.inputs["v_Kind"].push_back(i % 6);
        stage.inputs["gl_FrontFacing"].push_back(i < 8 ? 0xffffffffU : 0U);
    }
    stage.inputs["v_Place"] = words_of(counted(std::size_t{2} * count));
    stage.inputs["gl_FragCoord"] = words_of(counted(std::size_t{4} * count));
    stage.inputs["gl_PointCoord"] = words_of(Floats{0.5F, 0.75F});
    const text::StageResult made = stage.run(count);
    const Floats colour = floats_of(made.outputs.at("o_Colour")), depth = floats_of(made.outputs.at("gl_FragDepth"));
    for (std::uint32_t i = 0; i < count; ++i) {
        INFO("fragment " << i);
        const auto x = static_cast<float>(i);
        const Floats of(colour.begin() + 4 * i, colour.begin() + 4 * (i + 1));
        CHECK(made.is_discarded[i] == (i % 6 == 3 ? 1 : 0));
        if (i % 6 == 3)
            continue;
        if (i % 6 == 5) {
            CHECK(of == Floats(4));
            CHECK(made.outputs.at("o_Code")[i] == 9);
            CHECK(depth[i] == 0.25F);
            continue;
        }
        CHECK(of == Floats{2.0F * x, 2.0F * x + 1.0F, 4.0F * x, i < 8 ? 0.5F : 0.75F});
        CHECK(made.outputs.at("o_Code")[i] == i % 6);
        CHECK(depth[i] == (4.0F * x + 2.0F) * 0.5F);
    }
}

TEST_CASE("text stages: derivatives are differences in a quad of neighbours") {
    TextStage stage(Stage::fragment, R"(
        in float v_X;
        out vec3 o_Slopes;
        void main() {
            o_Slopes = vec3(dFdx(v_X), dFdy(v_X), fwidth(v_X));
        })");
    stage.inputs["v_X"] = words_of(Floats{1.0F, 3.0F, 0.0F, 10.0F, 5.0F, 5.0F, 5.0F, 4.0F});
    CHECK(refusal([&] {
              stage.run(8);
          }).ends_with("stage:5: a derivative needs neighbours, which are not given; expected invocations in quads"));
    stage.are_quads = true;
    CHECK(floats_of(stage.run(8).outputs.at("o_Slopes")) ==
          Floats{2.0F, -1.0F, 3.0F, 2.0F, 7.0F,  9.0F, 10.0F, -1.0F, 11.0F, 10.0F, 7.0F,  17.0F,
                 0.0F, 0.0F,  0.0F, 0.0F, -1.0F, 1.0F, -1.0F, 0.0F,  1.0F,  -1.0F, -1.0F, 2.0F});
    TextStage parted(Stage::fragment, R"(in float v_X;
        out float o_Slope;
        void main() {
            o_Slope = 0.0;
            if (v_X > 1.0)
                o_Slope = dFdx(v_X); })");
    parted.inputs["v_X"] = stage.inputs["v_X"];
    parted.are_quads = true;
    parted.run(8);
    CHECK(parted.found() == Lines{"6 derivative that not all of a quad come to: invocation 1's neighbour"});
}

TEST_CASE("text stages: a geometry stage emits vertices of its primitive's, in strips") {
    TextStage stage(Stage::geometry, R"(
        layout(triangles) in;
        layout(line_strip, max_vertices = 5) out;
        in vec2 v_Place[];
        in Lit { vec3 colour; int kind; } lit[];
        out vec2 g_Place;
        flat out int g_Kind;
        void emit(int corner) {
            g_Place = v_Place[corner] + lit[corner].colour.zx;
            g_Kind = lit[corner].kind * 100 + gl_PrimitiveIDIn;
            gl_Layer = corner;
            gl_Position = gl_in[corner].gl_Position * 2.0;
            EmitVertex();
        }
        void main() {
            if (gl_PrimitiveIDIn % 3 == 1)
                return;
            emit(0);
            emit(1);
            EndPrimitive();
            if (gl_PrimitiveIDIn % 3 == 2)
                for (int i = 0; i < 3; ++i)
                    emit(2 - i);
        })");
    constexpr std::uint32_t count = 20;
    stage.inputs["v_Place"] = words_of(counted(std::size_t{6} * count));
    stage.inputs["gl_Position"] = words_of(counted(std::size_t{12} * count));
    stage.inputs["Lit.colour"] = words_of(Floats{1.0F, 0.0F, 2.0F, 3.0F, 0.0F, 4.0F, 5.0F, 0.0F, 6.0F});
    for (std::uint32_t i = 0; i < 3 * count; ++i)
        stage.inputs["Lit.kind"].push_back(i);
    stage.is_watched = true;
    const text::StageResult made = stage.run(count);
    CHECK(stage.found().empty());
    const Floats place = floats_of(made.outputs.at("g_Place")), position = floats_of(made.outputs.at("gl_Position"));
    std::uint32_t vertex = 0, strip = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Words corners = i % 3 == 1 ? Words{} : i % 3 == 2 ? Words{0, 1, 2, 1, 0} : Words{0, 1};
        for (std::uint32_t k = 0; k < corners.size(); ++k, ++vertex) {
            INFO("primitive " << i << " vertex " << k);
            const std::uint32_t corner = corners[k], of = 3 * i + corner;
            REQUIRE(made.vertices > vertex);
            CHECK(place[2 * vertex] == static_cast<float>(2 * of + 2 * corner + 2));
            CHECK(place[2 * vertex + 1] == static_cast<float>(2 * of + 1 + 2 * corner + 1));
            CHECK(made.outputs.at("g_Kind")[vertex] == of * 100 + i);
            CHECK(made.outputs.at("gl_Layer")[vertex] == corner);
            CHECK(position[4 * vertex] == static_cast<float>(8 * of));
            if (k == 0 || k == 2) {
                REQUIRE(made.strips.size() > strip);
                CHECK(made.strips[strip].invocation == i);
                CHECK(made.strips[strip].first == vertex);
                CHECK(made.strips[strip].count == (k == 0 ? 2 : 3));
                ++strip;
            }
        }
    }
    CHECK(made.vertices == vertex);
    CHECK(made.strips.size() == strip);
}

TEST_CASE("text stages: a watched run finds outputs that are not written, and what it finds in compute stages") {
    const auto found = [](Stage stage, const std::string& text, std::uint32_t invocations = 4) {
        TextStage one(stage, text);
        one.is_watched = true;
        for (const text::StageVariable& input : one.program.stage_inputs)
            if (text::needs_words(input))
                one.inputs[text::name_of(input)] = words_of(counted(std::size_t{input.words()} * invocations));
        for (const text::Block& block : one.program.blocks)
            one.blocks[block.name] = Words(8);
        one.run(invocations);
        return one.found();
    };
    const std::string unwritten = "output that is not written: ", unset = "use of a variable that was never set: ";
    const std::string head = "in float a_X;\nout vec3 v_Colour;\n";
    CHECK(found(Stage::vertex, head + "void main() { gl_Position = vec4(a_X);\nv_Colour = vec3(a_X);\n}").empty());
    CHECK(found(Stage::vertex, // the brace stands behind the last statement: since glslang 15 main ends at its line
                head + "void main() { gl_Position = vec4(a_X);\nif (a_X > 2.0)\nv_Colour = vec3(a_X); }") ==
          Lines{"5 " + unwritten + "v_Colour"});
    CHECK(found(Stage::vertex, head + "void main() { if (a_X > 2.0) return;\nv_Colour = vec3(a_X);\n}") ==
          Lines{"3 " + unwritten + "v_Colour"});
    CHECK(found(Stage::vertex, head + "void main() { gl_Position = vec4(v_Colour, 1.0);\nv_Colour = vec3(a_X);\n}") ==
          Lines{"3 " + unset + "variable v_Colour"});
    CHECK(found(Stage::vertex, head + "void main() { vec3 c; if (a_X > 0.0) c.xy = vec2(1.0);\nv_Colour = c;\n}") ==
          Lines{"4 " + unset + "variable c"});
    CHECK(found(Stage::vertex, head + "void main() { v_Colour = vec3(sqrt(1.0 - a_X));\n}") ==
          Lines{"3 sqrt of a negative number: sqrt(-1)"});
    CHECK(found(Stage::fragment, "in float v_X; out vec4 o_Colour;\nvoid main() { if (v_X > 1.0) discard;\no_Colour = "
                                 "vec4(v_X); }")
              .empty());
    CHECK(found(Stage::fragment, "in float v_X; out vec4 o_Colour;\nvoid main() { if (v_X > 1.0) return;\no_Colour = "
                                 "vec4(v_X); }") == Lines{"2 " + unwritten + "o_Colour"});
    CHECK(found(Stage::fragment,
                "in float v_X; out vec4 o_Colour;\nvoid main() { o_Colour = vec4(1.0); if (v_X > 1.0)\ngl_FragDepth = "
                "v_X; }") == Lines{"3 " + unwritten + "gl_FragDepth"});
    TextStage endless(Stage::vertex, "void main() {\nfor (int i = 0; i > -1;) { if (gl_VertexID > 40) continue;\n"
                                     "break; }\ngl_Position = vec4(1.0); }\n");
    endless.is_watched = true;
    endless.most_branches = 1000;
    CHECK(endless.run(70).outputs.at("gl_Position").size() == 4 * text::lanes_at_once);
    CHECK(endless.found().size() == 1);
    // Of a sample, the vertices that are looked into alone.
    TextStage sampled(Stage::vertex, "void main() {\nfloat v;\ngl_Position = vec4(gl_VertexID < 64 ? 1.0 : v); }\n");
    const auto found_from = [&](std::uint32_t wanted) {
        text::Findings findings;
        text::StageRun run{.invocations = 100, .is_watched = true, .keeps_outputs = false};
        run.wants = [&](std::uint32_t first) { return first >= wanted; };
        text::run_stage(sampled.program, run, sampled.bindings(), named_profile("llvmpipe"), findings);
        return findings.all().empty() ? 0 : findings.all().front().place.invocation;
    };
    CHECK(found_from(0) == 64);
    CHECK(found_from(96) == 96);
    CHECK(found_from(100) == 0);
    const std::string strip =
        "layout(points) in;\nlayout(points, max_vertices = 2) out;\nin float v_X[]; out float g_X;\n";
    CHECK(found(Stage::geometry, strip + "void main() { g_X = v_X[0];\nEmitVertex();\nEmitVertex(); }") ==
          Lines{"6 " + unwritten + "g_X"});
    CHECK(found(Stage::geometry,
                strip + "void main() { for (int i = 0; i < 3; ++i) { g_X = v_X[0];\nEmitVertex(); } }") ==
          Lines{"5 more vertices than max_vertices: vertex 3 of 2"});
    CHECK(found(Stage::geometry, strip + "void main() { g_X = v_X[gl_PrimitiveIDIn];\nEmitVertex(); }") ==
          Lines{"4 index out of bounds: index 1 of 1 elements"});
    CHECK(found(Stage::vertex, head + "layout(std430, binding = 0) buffer Sums { float sums[]; };\nvoid main() {\n"
                                      "v_Colour = vec3(sums[0]);\nsums[gl_VertexID / 2] = a_X; }") ==
          Lines{"6 race on a buffer: invocation 0 writes what invocation 3 touched without an order between: Sums",
                "6 race on a buffer: invocation 1 writes what invocation 0 touched without an order between: Sums"});
}

} // namespace lockstep::test::written_stages_test
