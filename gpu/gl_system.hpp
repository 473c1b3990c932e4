#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "gpu/shader_source.hpp"
#include "gpu/system_side.hpp"
#include "reference/model/arithmetic_switch.hpp"
#include "reference/model/image.hpp"

namespace lockstep {

/// A uniform's value; its type in GLSL is this one.
using UniformValue = std::variant<float, int, unsigned, bool, glm::vec2, glm::vec3, glm::vec4, glm::ivec2, glm::ivec3,
                                  glm::ivec4, glm::uvec2, glm::uvec3, glm::uvec4, glm::mat2, glm::mat3, glm::mat4>;
using Uniforms = std::map<std::string, UniformValue>;

/// Three words of an item that say how many groups a dispatch has.
struct GroupCounts {
    FieldId field; ///< three uints, of a buffer with storage blocks
    std::size_t item = 0;
};

/// What a storage block, sampler or image uniform of a shader is, which goes by a name of its own.
struct GlName {
    enum class Kind : std::uint8_t {
        before,  ///< as the pass found it
        after,   ///< as it leaves it: every item is written
        in_place ///< both; of a buffer whose fields have a block always so
    };
    std::uint8_t resource = 0;
    Kind kind = Kind::before;
    bool is_sampler = false;
};

/// How a shader's texture() reads an image of the state: GL_LINEAR, at its edges clamped or with 0 beyond them.
enum class GlFilter : std::uint8_t { linear, linear_in_black };

/// How a vertex pass with NAME.frag draws images: output i of each fragment goes into a texel of the pass's image, or
/// of the i-th pass that continues it. One of three dimensions is drawn in layers: NAME.geom writes gl_Layer. What is
/// drawn into srgb8_alpha8 is encoded by GL (GL_FRAMEBUFFER_SRGB).
struct GlDraw {
    enum class Primitive : std::uint8_t { points, triangles };
    enum class Blend : std::uint8_t { none, added, by_alpha }; ///< GL_ONE, GL_ONE; GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA
    std::uint8_t buffer = 0; ///< whose items are the vertices, with its fields as attributes
    Primitive primitive = Primitive::points;
    Blend blend = Blend::none;
    bool sized = false;                     ///< points are gl_PointSize pixels wide; else 1
    bool has_depth = false;                 ///< tested LESS, in a depth buffer (32 bits) of the draw's own, 1 at first
    bool clears = true;                     ///< texels are 0 before; else as the pass before left them
    std::vector<glm::vec4> cleared_to = {}; ///< by output, instead of 0
    std::size_t vertices = 0;  ///< of an instance, gl_VertexID; then each item is an instance. 0: each is a vertex
    bool has_geometry = false; ///< there is a NAME.geom
    bool once = false;         ///< one instance without attributes, of `vertices`
    std::size_t instances = 0; ///< how often the items, each a vertex, are drawn: gl_InstanceID. 0: once
};

/// A pass on GL: a shader that makes every item of a buffer or image anew.
///
/// NAME.vert: attributes a_Field and captured outputs out_Field of each field, `collide_time` being a_CollideTime.
/// NAME.comp: storage blocks BufferBefore and BufferAfter of each buffer, `grains` being GrainsBefore, an item a record
/// of its fields in the schema's order without gaps (a struct of scalars; a vec3 would leave one). A buffer whose
/// fields have blocks of their own (Field::block) is changed in place, in a copy of what the pass before left; behind
/// its records lie as many as a group has, which nobody may write.
///
/// An image of the state (Resource::format, gpu/state_image.hpp) is read by any stage as a sampler, `light` by
/// u_LightBefore with texelFetch. A compute pass of an image writes u_LightAfter, an image uniform, by imageStore, and
/// has at least an invocation a texel, along each axis; with `invocations`, along one axis, it changes the image in
/// place, by atomics, in a copy of what the pass before left. A vertex pass of an image draws it (`draw`).
struct GlPass {
    std::string name;
    /// Or compute; or fragment: its draw is one triangle over the whole image, by a vertex stage that lockstep has
    /// (full_screen.vert). Fragments that are discarded leave their texel as it was.
    Stage stage = Stage::vertex;
    std::uint8_t resource = 0;
    /// What its uniforms are in a frame; u_ItemCount is set by itself. May be empty.
    std::function<Uniforms(int frame)> uniforms = {};
    /// Of a compute pass: its other storage blocks by name, and what they hold in a frame, float after float.
    std::map<std::string, std::function<std::vector<float>(int frame)>> data = {};
    ShaderDefines defines = {};               ///< besides those of the arithmetic
    ShaderTexts texts = {};                   ///< files that the host makes
    std::function<bool(int frame)> runs = {}; ///< as ItemPass::runs; empty: in every frame
    bool continues = false; ///< the dispatch of the pass before wrote this buffer as well; there is no shader
    /// Of a vertex pass that draws: the buffer of which each item is an instance, with its fields as attributes. An
    /// item of `resource` is then a vertex of an instance (gl_VertexID), as many a one as divide evenly.
    std::optional<std::uint8_t> instances_of = {};
    /// Of a vertex pass of an image.
    std::optional<GlDraw> draw = {};
    /// Of a compute pass: how many invocations a frame has, at least; empty: one an item of `resource`. Items that none
    /// makes stay as they were.
    std::function<std::size_t(int frame)> invocations = {};
    /// Images that it reads by texture(), filtered.
    std::map<std::uint8_t, GlFilter> filters = {};
    /// Of a compute pass of an image of one 32-bit component: the shader declares it r32ui, and atomics change its
    /// bits.
    bool writes_words = false;
    /// Of a compute pass: where its group counts lie, for an indirect dispatch. Items that no group makes stay as they
    /// were.
    std::optional<GroupCounts> indirect = {};
    /// Of a compute pass: how many invocations it has along each axis, at least, instead of as many as its items take.
    std::optional<std::array<std::uint32_t, 3>> size = {};
    /// Names of its shader's blocks, samplers and images beside those above; where one is an image's, none of those.
    std::map<std::string, GlName, std::less<>> names = {};
    /// Uniform blocks whose members get values by their names in GL, as plain uniforms do: Frame.tick, or tick.
    std::vector<std::string> uniform_blocks = {};
    GivenInputs inputs = {}; ///< of a fragment stage that draws the whole image
    /// How a uniform that nothing is given for gets a value, for messages; empty: by bindings.json.
    std::string advice = {};

    /// Whether it draws by vertices of its own, whose places a fixed function makes pixels of: no text says these.
    [[nodiscard]] bool draws_vertices() const { return draw && stage != Stage::fragment; }
    /// Whether the shader may leave items out of a buffer in two copies.
    [[nodiscard]] bool keeps() const { return (invocations && names.empty()) || indirect; }
};

/// With what its files are put together.
StageInput stage_input(const GlPass& pass, ArithmeticSwitch arithmetic);

/// How a vertex pass of instances is drawn with NAME.frag: over one colour, triangles in the order of the instances, by
/// an indirect call a batch.
struct GlPicture {
    int width = 960, height = 540;
    Rgba8 background;
    std::vector<std::uint32_t> indices; ///< of an instance's vertices, three a triangle
    /// Instances that are drawn by one call.
    struct Batch {
        std::size_t first = 0, count = 0;
        GlDraw::Blend blend = GlDraw::Blend::by_alpha;
        bool writes_depth = false; ///< tested LESS, as all batches are where one writes it
        Uniforms uniforms = {};    ///< of this call, besides the pass's
    };
    std::vector<Batch> batches = {}; ///< in their order; none: all instances, blended by alpha
};

/// The GPU side of a system, in the current context: each pass reads the state that the one before left, in one copy of
/// each buffer and image, and writes the other.
class GlSystem final : public SystemSide {
  public:
    /// `shaders`: the folder of the passes' files, which may include the shipped arithmetic.glsl. `schema` outlives
    /// this. Throws Error for what is wrong with a shader or an image's format.
    GlSystem(const Schema& schema, std::vector<GlPass> passes, std::filesystem::path shaders,
             ArithmeticSwitch arithmetic = ArithmeticSwitch::plain);

    ~GlSystem() override;

    void upload(const SystemView& state) override;
    void step(std::size_t pass, int frame) override;
    void read(SystemState& state) const override;
    [[nodiscard]] std::optional<bool> holds(const View& state) const override; ///< of buffers
    [[nodiscard]] std::optional<bool> left(const View& before) const override; ///< of buffers
    [[nodiscard]] bool reaches(std::size_t pass, FieldId field) const override;
    [[nodiscard]] std::optional<std::uint64_t> ran_over() const override;

    [[nodiscard]] bool repeats() const override { return true; }
    void lay_canary(std::size_t pass) override;
    void repeat_step(std::size_t pass, int frame) override;

    /// Whether each stage that computes a part of the state says `precise` of something.
    [[nodiscard]] bool says_precise() const;
    [[nodiscard]] bool says_precise_once() const; ///< one of them does

    /// Seconds that the last step's draw or dispatch took, nothing else with it: to glFinish, and by the GPU's own
    /// clock (GL_TIME_ELAPSED). Of steps after time_steps(true).
    struct Seconds {
        double wall = 0.0, timer = 0.0;
    };
    void time_steps(bool on);
    [[nodiscard]] Seconds seconds() const;

    /// What a pass of instances draws from the state as it is.
    [[nodiscard]] ColorImage picture(std::size_t pass, int frame, const GlPicture& how);

    /// Of a vertex pass: its outputs named trace_*, from the same files with LOCKSTEP_TRACE defined.
    std::vector<CapturedVertex> trace(std::size_t pass, int frame, std::size_t item) override;

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// "CollideTime" of "collide_time".
std::string shader_name(std::string_view name);

} // namespace lockstep
