#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "crosscheck/collision/judge/check.hpp"
#include "crosscheck/collision/record/trace_info.hpp"
#include "reference/model/collision/particles.hpp"
#include "reference/model/image.hpp"

namespace lockstep::test {

/// 60 particles that meet over a plane, 24x20 texels.
Scene small_scene();

/// Says that llvmpipe ran it.
TraceInfo small_info(bool has_cdt);

/// Changes what is recorded of a frame.
using Edit = std::function<void(int frame, Particles& particles, CollisionImage& cdt)>;

/// Writes a trace of what the reference computes with info's profile, and `edit` makes of it.
void record(const std::filesystem::path& file, const TraceInfo& info, int frames, const Edit& edit = {});

/// All of a trace's frames, by the profile of the driver that it names.
CheckReport check_trace(const std::filesystem::path& file, CheckMode mode = CheckMode::resync);

/// What an Error says, or nothing if there is none.
std::string error_of(const std::function<void()>& action);

/// The file's bytes, and back.
std::string bytes_of(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, const std::string& bytes);

/// Changes some of a trace's bytes after the seal, and seals it again: what somebody would do on purpose.
void tamper(const std::filesystem::path& file, const std::function<void(std::string&)>& change);

} // namespace lockstep::test
