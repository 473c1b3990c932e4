#include <array>
#include <cstdint>

#include "gpu/context_backend.hpp"
#include "gpu/gl.hpp"
#include "gpu/shared_library.hpp"

namespace lockstep {
namespace {

// OSMesa's interface, declared here so that its header is not needed to build (it left Mesa in 25.1).
using OSMesaContext = struct osmesa_context*;
constexpr int osmesa_rgba = GL_RGBA;
constexpr int osmesa_format = 0x22;
constexpr int osmesa_profile = 0x33;
constexpr int osmesa_core_profile = 0x34;
constexpr int osmesa_context_major_version = 0x36;
constexpr int osmesa_context_minor_version = 0x37;

struct OSMesa {
    OSMesaContext (*create)(const int* attributes, OSMesaContext share) = nullptr;
    void (*destroy)(OSMesaContext) = nullptr;
    GLboolean (*make_current)(OSMesaContext, void* pixels, GLenum type, GLsizei width, GLsizei height) = nullptr;
    void* (*get_proc_address)(const char*) = nullptr;

    OSMesa() {
        const SharedLibrary library("LOCKSTEP_OSMESA_LIBRARY", {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
        library.get(create, "OSMesaCreateContextAttribs");
        library.get(destroy, "OSMesaDestroyContext");
        library.get(make_current, "OSMesaMakeCurrent");
        library.get(get_proc_address, "OSMesaGetProcAddress");
    }
};

class OSMesaBackend final : public ContextBackend {
  public:
    OSMesaBackend() {
        for (const auto& [major, minor] : context_versions) {
            const std::array<int, 9> attributes{osmesa_format,
                                                osmesa_rgba,
                                                osmesa_profile,
                                                osmesa_core_profile,
                                                osmesa_context_major_version,
                                                major,
                                                osmesa_context_minor_version,
                                                minor,
                                                0};
            context_ = api_.create(attributes.data(), nullptr);
            if (context_ != nullptr)
                return;
        }
        throw Error("OSMesa has no GL 3.3 core context to give");
    }
    ~OSMesaBackend() override { api_.destroy(context_); }

    void make_current() override {
        if (api_.make_current(context_, &pixel_, GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE)
            throw Error("OSMesaMakeCurrent failed");
    }
    void release() override { api_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
    void* resolve(const char* name) override { return api_.get_proc_address(name); }

  private:
    OSMesa api_;
    OSMesaContext context_ = nullptr;
    std::uint32_t pixel_ = 0; ///< the default framebuffer OSMesa insists on
};

} // namespace

std::unique_ptr<ContextBackend> make_osmesa_context() { return std::make_unique<OSMesaBackend>(); }

} // namespace lockstep
