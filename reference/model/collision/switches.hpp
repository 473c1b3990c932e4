#pragma once
#include <span>
#include <string>
#include <string_view>

#include "reference/model/arithmetic_switch.hpp"

namespace lockstep {

/// Where the thesis's listing (Fig. 3-3) and its text disagree or are silent, both readings can be chosen
/// (spec, "The listing"). Every switch works in the reference and in the shader.

/// Where a particle looks for what it hits: in the CDT; in the octree the thesis compares it with (octree.hpp), which
/// then takes the place of the passes that draw and read the CDT; or in the obstacles' depth, as engines do, which is
/// drawn into the CDT in the place of positions.
enum class Search { cdt, octree, depth };
/// Which stage makes the listing's step: a vertex stage whose outputs are captured, drawn as points, or a compute stage
/// that finds the texel of each point, and the nearest point of each texel, by itself.
enum class Step { transform_feedback, compute };
enum class PerspectiveDivide { off, on };
enum class TexCoord { times_half };
enum class BaseTexel { truncate, floor };
enum class SelfPosition { texel, vertex };
enum class EmptyTexel { phantom, skip };
enum class OutsideImage { skip };
/// A stored position at distance 0 is most often the particle itself, drawn one texel beside the one it computes; the
/// listing collides with it and divides by zero.
enum class ZeroDistance { hit, skip };
enum class CollisionStep { full, tick };
enum class SearchWhen { collide_time_negative };
/// What becomes of a particle that does not search. By its indentation, the listing's branch without a hit (line 25)
/// lies inside that of the search (line 8): then it keeps its state, collide time included. The text has it fall.
enum class NotSearching { moves, stands };
enum class CdtFormat { rgba32f, rgba16f, rgba8 };
enum class CdtCamera { moving, fixed };
enum class ObstaclesInCdt { off, vertices, triangles };
/// How a particle holds its velocity: as the listing does, or as one vector, which is its direction then, its speed 1.
enum class Velocity { direction_and_speed, vector };
/// Which position the point is rasterised at: the text projects the updated one, the listing writes gl_Position
/// once, from the position before the step.
enum class RasterPosition { before_step, updated };

/// Beyond the thesis (layered_cdt.hpp): with any of cdt_layers, search_window, cdt_cameras and response off its first
/// value, the layered collision pass takes the collision pass's place.
enum class SearchWindow { texels, projected };
enum class Response { single, mutual };

struct Switches {
    Search search = Search::cdt;
    Step step = Step::transform_feedback;
    PerspectiveDivide perspective_divide = PerspectiveDivide::on;
    TexCoord texcoord = TexCoord::times_half;
    BaseTexel base_texel = BaseTexel::floor;
    SelfPosition self_position = SelfPosition::vertex;
    EmptyTexel empty_texel = EmptyTexel::skip;
    OutsideImage outside_image = OutsideImage::skip;
    ZeroDistance zero_distance = ZeroDistance::skip;
    CollisionStep collision_step = CollisionStep::tick;
    SearchWhen search_when = SearchWhen::collide_time_negative;
    NotSearching not_searching = NotSearching::moves;
    CdtFormat cdt_format = CdtFormat::rgba32f;
    CdtCamera cdt_camera = CdtCamera::moving;
    ObstaclesInCdt obstacles_in_cdt = ObstaclesInCdt::triangles;
    Velocity velocity = Velocity::direction_and_speed;
    RasterPosition raster_position = RasterPosition::updated;
    ArithmeticSwitch arithmetic = ArithmeticSwitch::plain;
    int cdt_layers = 1;  ///< 1 to 8
    int cdt_cameras = 1; ///< 1 or 2
    SearchWindow search_window = SearchWindow::texels;
    Response response = Response::single;
    float speed_factor = 0.8F;      ///< factor on the speed at a hit
    float cdt_camera_offset = 0.0F; ///< world units along +z (eq. 1), for a moving collision camera

    bool operator==(const Switches&) const = default;
};

/// Whether the pass itself finds the texel and the depth that a point is drawn with; otherwise the rasteriser does.
bool places_points(const Switches& switches);

/// One switch as scene files, --set and shaders name it.
struct SwitchInfo {
    std::string_view name;
    std::span<const std::string_view> values; ///< empty: a finite number
    std::string_view meaning;
    int (*get)(const Switches&); ///< index into values; null for a number
    void (*set)(Switches&, int);
    float Switches::*number; ///< null for a named value
};

std::span<const SwitchInfo> switch_table();

/// What preset() knows, in the order in which they are told.
std::span<const std::string_view> preset_names();

/// `listing`: the listing (Fig. 3-3) as printed, line by line. `paper`: its search and its answers, with the divide and
/// the drawn position of the text, without which nothing is found where it is stored. `corrected`: what the text means.
/// `exact`: corrected, in portable arithmetic. Throws Error naming the presets for any other name.
Switches preset(std::string_view name);

/// Sets one switch from text. Throws Error naming the switches, or the allowed values.
void set_switch(Switches& switches, std::string_view name, std::string_view value);

/// The value of a switch as text; set_switch reads it back to the same bits.
std::string switch_value(const Switches& switches, std::string_view name);

} // namespace lockstep
