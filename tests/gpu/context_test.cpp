#include <catch2/catch.hpp>

#include <cstdlib>

#include <fmt/format.h>

#include "gpu/check.hpp"
#include "gpu/gl.hpp"
#include "gpu/object.hpp"
#include "gpu/shared_library.hpp"
#include "tests/gpu/any_context.hpp"

namespace lockstep::test::context_test {

using test::open_context;
using Backend = ContextRequest::Backend;

namespace {

/// Clears one texel and reads it back: the context really draws.
float drawn_value() {
    const GlTexture texture;
    gl::BindTexture(GL_TEXTURE_2D, texture.id());
    gl::TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 1, 1, 0, GL_RGBA, GL_FLOAT, nullptr);
    const GlFramebuffer framebuffer;
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    gl::FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
    check_framebuffer(GL_FRAMEBUFFER, "one texel");
    const float value[4] = {0.1F, 0.2F, 0.3F, 0.4F};
    gl::ClearBufferfv(GL_COLOR, 0, value);
    float read[4] = {};
    gl::ReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, read);
    check_gl("one texel");
    return read[2];
}

} // namespace

TEST_CASE("context: names are read and written back") {
    for (const char* name : {"auto", "osmesa", "egl", "egl-device:0", "egl-device:12"})
        CHECK(context_request_text(parse_context_request(name)) == name);
    CHECK(parse_context_request("egl-device:3") == ContextRequest{Backend::egl_device, 3});
}

TEST_CASE("context: an unknown name is refused with what is allowed, and what is near it") {
    for (const char* name : {"glx", "", "egl-device", "egl-device:", "egl-device:-1", "egl-device:1x", "OSMesa"})
        CHECK_THROWS_WITH(parse_context_request(name),
                          Catch::StartsWith(fmt::format("unknown GL context '{}'; allowed are auto, osmesa, egl, "
                                                        "egl-device:N (N = 0, 1, ...)",
                                                        name)));
    CHECK_THROWS_WITH(parse_context_request("egl-device"), Catch::EndsWith("; did you mean egl-device:0?"));
}

TEST_CASE("context: OSMesa and EGL come up, draw and say what they are") {
    for (const char* name : {"osmesa", "egl"}) {
        const auto context = open_context(name);
        if (!context)
            continue;
        const ContextInfo& info = context->describe();
        CAPTURE(name, info.renderer, info.version);
        CHECK(info.backend == name);
        CHECK_THAT(info.renderer, Catch::Contains("llvmpipe") || Catch::Contains("softpipe"));
        CHECK(info.major * 10 + info.minor >= 33);
        CHECK(info.precise);
        CHECK(info.subpixel_bits >= 4);
        CHECK(info.max_xfb_interleaved_components >= 64);
        CHECK(info.max_viewport_width >= 500);
        CHECK(drawn_value() == 0.3F);
    }
}

TEST_CASE("context: optional functions follow version and extensions") {
    const auto context = open_context();
    if (!context)
        return;
    CHECK((gl::ClipControl != nullptr) == gl::offers(4, 5, "GL_ARB_clip_control"));
    CHECK((gl::DispatchCompute != nullptr) == gl::offers(4, 3, "GL_ARB_compute_shader"));
    CHECK_FALSE(gl::offers(9, 9, "GL_LOCKSTEP_no_such_extension"));
    CHECK(gl::offers(3, 3, "GL_LOCKSTEP_no_such_extension"));
}

TEST_CASE("context: contexts of both libraries take turns in one process") {
    for (int round = 0; round < 2; ++round)
        for (const char* name : {"osmesa", "egl"}) {
            const auto context = open_context(name);
            if (context)
                CHECK(drawn_value() == 0.3F);
        }
    auto first = open_context("osmesa");
    auto second = open_context("egl");
    if (!first || !second)
        return;
    CHECK(drawn_value() == 0.3F);
    first->make_current();
    CHECK(drawn_value() == 0.3F);
    second.reset();
    CHECK(gl::DrawArrays != nullptr);
    CHECK(drawn_value() == 0.3F);
    first.reset();
    CHECK(gl::DrawArrays == nullptr);
}

TEST_CASE("context: each keeps its own state through the turns") {
    auto egl = open_context("egl");
    if (!egl)
        return;
    gl::PointSize(3.0F);
    auto osmesa = open_context("osmesa");
    if (!osmesa)
        return;
    const auto point_size = [] {
        float size = 0.0F;
        gl::GetFloatv(GL_POINT_SIZE, &size);
        return size;
    };
    CHECK(point_size() == 1.0F);
    egl->make_current();
    CHECK(point_size() == 3.0F);
    osmesa->make_current();
    CHECK(point_size() == 1.0F);
}

TEST_CASE("context: a move keeps it current") {
    auto context = open_context();
    if (!context)
        return;
    const Context moved = std::move(*context);
    context.reset();
    CHECK(drawn_value() == 0.3F);
    CHECK(moved.describe().major >= 3);
}

TEST_CASE("context: a device that is not there is told with the ones that are") {
    CHECK_THROWS_WITH(Context(parse_context_request("egl-device:99")),
                      Catch::StartsWith("no GL context: egl-device:99: "));
}

TEST_CASE("context: every kind is probed without a crash") {
    const std::vector<ContextProbe> probes = available_contexts();
    REQUIRE(probes.size() >= 2);
    for (const ContextProbe& probe : probes) {
        const std::string name = context_request_text(probe.request);
        CAPTURE(name, probe.error, probe.info.renderer);
        if (probe.error.empty())
            CHECK(probe.info.backend == name);
        else
            CHECK_THAT(probe.error, Catch::Contains(name));
        CHECK(probe.error.empty() == !probe.info.renderer.empty());
    }
    CHECK(gl::DrawArrays == nullptr);
}

namespace {

/// An environment variable, until the end of a test.
class Environment {
  public:
    Environment(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;
    ~Environment() { unsetenv(name_); }

  private:
    const char* name_;
};

} // namespace

TEST_CASE("context: without any GL library every reason is given, in one line") {
    const Environment osmesa("LOCKSTEP_OSMESA_LIBRARY", "/no/such/libOSMesa.so");
    const Environment egl("LOCKSTEP_EGL_LIBRARY", "/no/such/libEGL.so");
    CHECK_THROWS_WITH(Context(), Catch::StartsWith("no GL context: osmesa: /no/such/libOSMesa.so: cannot open") &&
                                     Catch::Contains("; egl: /no/such/libEGL.so: cannot open") &&
                                     Catch::Contains("LOCKSTEP_OSMESA_LIBRARY can name another library") &&
                                     !Catch::Contains("\n"));
    CHECK_THROWS_WITH(Context(parse_context_request("egl-device:0")),
                      Catch::StartsWith("no GL context: egl-device:0: /no/such/libEGL.so"));
    CHECK(gl::DrawArrays == nullptr);
    const std::vector<ContextProbe> probes = available_contexts();
    REQUIRE(probes.size() == 2);
    CHECK_FALSE(probes[0].error.empty());
    CHECK_FALSE(probes[1].error.empty());
}

TEST_CASE("context: auto passes over a library that does not work") {
    if (!open_context("egl"))
        return;
    const Environment osmesa("LOCKSTEP_OSMESA_LIBRARY", "libm.so.6");
    CHECK_THROWS_WITH(Context(parse_context_request("osmesa")),
                      Catch::StartsWith("no GL context: osmesa: libm.so.6 lacks OSMesaCreateContextAttribs"));
    CHECK_THAT(Context().describe().backend, Catch::StartsWith("egl"));
}

TEST_CASE("context: a library that does not load for want of another says which") {
    const Environment osmesa("LOCKSTEP_OSMESA_LIBRARY", LOCKSTEP_UNLOADABLE_OSMESA);
    CHECK_THROWS_WITH(Context(parse_context_request("osmesa")),
                      Catch::Contains(std::string(LOCKSTEP_UNLOADABLE_OSMESA) + ": ") &&
                          Catch::Contains("undefined symbol: of_another_release"));
}

TEST_CASE("context: every library that was tried is told with what the loader said") {
    const auto open = [] {
        SharedLibrary("LOCKSTEP_NO_LIBRARY", {"libnone.so.1", "libnone.so", LOCKSTEP_UNLOADABLE_OSMESA});
    };
    CHECK_THROWS_WITH(open(), Catch::StartsWith("libnone.so.1: cannot open shared object file") &&
                                  Catch::Contains(", libnone.so: cannot open shared object file") &&
                                  Catch::Contains("undefined symbol: of_another_release") &&
                                  Catch::EndsWith(" (LOCKSTEP_NO_LIBRARY can name another library)"));
}

TEST_CASE("context: a library that is there and does not load is told, one that is not there is passed over") {
    CHECK(SharedLibrary::broken({"libnone.so", "libm.so.6"}).empty());
    CHECK_THAT(SharedLibrary::broken({"libnone.so", LOCKSTEP_UNLOADABLE_OSMESA}),
               Catch::StartsWith(" (" LOCKSTEP_UNLOADABLE_OSMESA ": undefined symbol: of_another_release"));
}

TEST_CASE("context: a driver that crashes is an error of its probe") {
    const Environment osmesa("LOCKSTEP_OSMESA_LIBRARY", LOCKSTEP_CRASHING_OSMESA);
    CHECK(available_contexts().front().error == "osmesa: the driver crashed with signal 6 (Aborted)");
}

TEST_CASE("context: a driver that crashes is refused with what chose it, and auto passes over it") {
    const Environment osmesa("LOCKSTEP_OSMESA_LIBRARY", LOCKSTEP_CRASHING_OSMESA);
    CHECK_THROWS_WITH(Context(parse_context_request("osmesa")),
                      Catch::StartsWith("no GL context: osmesa: the driver crashed with signal 6 (Aborted); the "
                                        "environment may be why: LOCKSTEP_OSMESA_LIBRARY is "));
    if (open_context("egl"))
        CHECK_THAT(Context().describe().backend, Catch::StartsWith("egl"));
}

TEST_CASE("check_gl: an error is named once, with what was done") {
    const auto context = open_context();
    if (!context)
        return;
    gl::Enable(0x1234);
    CHECK_THROWS_WITH(check_gl("collision_pass"), "collision_pass: GL_INVALID_ENUM");
    CHECK_NOTHROW(check_gl("collision_pass"));
}

TEST_CASE("check_framebuffer: an incomplete framebuffer names its status") {
    const auto context = open_context();
    if (!context)
        return;
    const GlFramebuffer framebuffer;
    gl::BindFramebuffer(GL_FRAMEBUFFER, framebuffer.id());
    CHECK_THROWS_WITH(check_framebuffer(GL_FRAMEBUFFER, "CDT"),
                      "CDT: framebuffer is not complete: GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT");
}

} // namespace lockstep::test::context_test
