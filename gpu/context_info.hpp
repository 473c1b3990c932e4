#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace lockstep {

/// What a context says of itself. Integers are GL's own limits, sizes in texels or components.
struct ContextInfo {
    std::string backend; ///< osmesa, egl, egl-device:N
    std::string vendor;
    std::string renderer;
    std::string version; ///< GL_VERSION, driver version included
    std::string glsl;
    int major = 0;
    int minor = 0;
    bool precise = false;      ///< GLSL has the `precise` qualifier (4.00 or GL_ARB_gpu_shader5)
    bool clip_control = false; ///< GL 4.5 or GL_ARB_clip_control
    bool compute = false;      ///< compute shaders with storage buffers and image stores (GL 4.3)
    int subpixel_bits = 0;
    int max_texture_size = 0;
    int max_viewport_width = 0;
    int max_viewport_height = 0;
    int max_xfb_interleaved_components = 0;
    int max_vertex_uniform_components = 0;
    int max_geometry_uniform_components = 0;
    int max_fragment_uniform_components = 0;
    int max_geometry_output_vertices = 0;
    int max_texture_units = 0;    ///< of all stages together
    float min_point_size = 0.0F;  ///< pixels
    float max_point_size = 0.0F;  ///< pixels
    int timer_bits = 0;           ///< GL_TIME_ELAPSED counter bits, 0: no timer
    long long max_ssbo_bytes = 0; ///< 0 without compute
};

/// Of the current context.
ContextInfo query_context_info(std::string backend);

/// One line: renderer, version, backend.
std::string summary(const ContextInfo& info);

void to_json(nlohmann::json& json, const ContextInfo& info);
void from_json(const nlohmann::json& json, ContextInfo& info);

} // namespace lockstep
