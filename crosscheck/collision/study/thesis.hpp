#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// The measurements of the thesis's chapters 4 and 5, made again in the current GL context, and of chapter 2's
/// collision with the scene's depth beside them.
///
/// A density is a property of an emitter, not of a count: the emitters of the scene files are as dense as they are with
/// 200,000 particles, and fewer make them shorter along their direction. The thesis does not say where its particles
/// start.

/// One system over some frames.
struct SystemTimes {
    int frames = 0;      ///< measured
    double wall = 0.0;   ///< seconds a frame until GL has finished, the octree's refresh on the CPU included; mean
    double gpu = 0.0;    ///< seconds a frame by the GPU's own clock, without that refresh; 0: it has none
    double fixed = 0.0;  ///< `wall` of the same scene with one particle: obstacles, clearing, waiting; 0: not measured
    double recall = 0.0; ///< of the particles in contact after the CDT's last frame, those that see a neighbour; may be
                         ///< NaN
    double answers = 0.0; ///< of the particles that touch an obstacle then, those whose search finds anything; likewise
};

struct ThesisCell {
    std::string scene;
    std::size_t particles = 0;
    SystemTimes cdt;
    std::optional<SystemTimes> octree; ///< needs GL 4.3
    std::optional<SystemTimes> depth;  ///< likewise; the obstacles' depth, which holds no particles

    /// Time over the CDT's.
    [[nodiscard]] std::optional<double> octree_ratio() const;
    [[nodiscard]] std::optional<double> depth_ratio() const;
};

inline constexpr std::array<std::string_view, 5> thesis_scenes{"bunny_a", "bunny_b", "dragon_a", "dragon_b",
                                                               "x_streams"};

struct ThesisOptions {
    std::filesystem::path scenes; ///< folder of the scene files
    std::filesystem::path shaders;
    std::optional<std::string> preset; ///< this and `set` as in SceneOptions
    std::vector<std::string> set;      ///< octree_size is the thesis's 50 unless named here
    std::vector<std::size_t> counts{50'000, 100'000, 150'000, 200'000};
    int frames = 60;      ///< a measurement, at most; frame 0, in which nobody searches, is not measured
    double seconds = 5.0; ///< a measurement ends with the frame in which this is over
    bool compute = true;  ///< octree and depth, too
    std::function<void(std::string_view what, std::string_view reason)> on_left_out; ///< before anything is measured
    std::function<void(const ThesisCell&)> on_cell;
};

/// Every scene that loads with every count, all systems; a scene without its mesh is left out, as is the depth where it
/// does not go with `preset` and `set`. Throws Error as load_scene does of x_streams, which needs no mesh, and as
/// GpuSimulation does.
std::vector<ThesisCell> thesis_study(const ThesisOptions& options);

} // namespace lockstep
