// No native window system: keeps X11 headers out of EGL's.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "gpu/context_backend.hpp"
#include "gpu/shared_library.hpp"

namespace lockstep {
namespace {

struct Egl {
    decltype(&::eglBindAPI) BindAPI = nullptr;
    decltype(&::eglChooseConfig) ChooseConfig = nullptr;
    decltype(&::eglCreateContext) CreateContext = nullptr;
    decltype(&::eglDestroyContext) DestroyContext = nullptr;
    decltype(&::eglGetError) GetError = nullptr;
    decltype(&::eglGetProcAddress) GetProcAddress = nullptr;
    decltype(&::eglInitialize) Initialize = nullptr;
    decltype(&::eglMakeCurrent) MakeCurrent = nullptr;
    decltype(&::eglQueryString) QueryString = nullptr;
    PFNEGLGETPLATFORMDISPLAYEXTPROC GetPlatformDisplayEXT = nullptr;
    PFNEGLQUERYDEVICESEXTPROC QueryDevicesEXT = nullptr;
    PFNEGLQUERYDEVICESTRINGEXTPROC QueryDeviceStringEXT = nullptr;

    Egl() {
        const SharedLibrary library("LOCKSTEP_EGL_LIBRARY", {"libEGL.so.1", "libEGL.so"});
        library.get(BindAPI, "eglBindAPI");
        library.get(ChooseConfig, "eglChooseConfig");
        library.get(CreateContext, "eglCreateContext");
        library.get(DestroyContext, "eglDestroyContext");
        library.get(GetError, "eglGetError");
        library.get(GetProcAddress, "eglGetProcAddress");
        library.get(Initialize, "eglInitialize");
        library.get(MakeCurrent, "eglMakeCurrent");
        library.get(QueryString, "eglQueryString");
        // Extensions that need no display; the function pointer alone does not say that one is there.
        if (client_offers("EGL_EXT_platform_base"))
            extension(GetPlatformDisplayEXT, "eglGetPlatformDisplayEXT");
        if (client_offers("EGL_EXT_device_enumeration") || client_offers("EGL_EXT_device_base"))
            extension(QueryDevicesEXT, "eglQueryDevicesEXT");
        if (client_offers("EGL_EXT_device_query") || client_offers("EGL_EXT_device_base"))
            extension(QueryDeviceStringEXT, "eglQueryDeviceStringEXT");
    }

    [[nodiscard]] bool client_offers(std::string_view name) const {
        return listed(QueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), name);
    }
    [[nodiscard]] bool display_offers(EGLDisplay display, std::string_view name) const {
        return listed(QueryString(display, EGL_EXTENSIONS), name);
    }
    [[nodiscard]] std::vector<EGLDeviceEXT> devices() const {
        EGLint count = 0;
        if (QueryDevicesEXT == nullptr || QueryDevicesEXT(0, nullptr, &count) == EGL_FALSE)
            return {};
        std::vector<EGLDeviceEXT> list(static_cast<std::size_t>(count));
        if (QueryDevicesEXT(count, list.data(), &count) == EGL_FALSE)
            return {};
        list.resize(static_cast<std::size_t>(count));
        return list;
    }

    static bool listed(const char* extensions, std::string_view name) {
        std::string_view rest = extensions != nullptr ? extensions : "";
        while (!rest.empty()) {
            const std::size_t space = std::min(rest.find(' '), rest.size());
            if (rest.substr(0, space) == name)
                return true;
            rest.remove_prefix(std::min(space + 1, rest.size()));
        }
        return false;
    }

  private:
    template <class Function> void extension(Function& function, const char* name) {
        function = reinterpret_cast<Function>(GetProcAddress(name));
    }
};

class EglBackend final : public ContextBackend {
  public:
    EglBackend(const Egl& egl, EGLDisplay display) : egl_(egl), display_(display) {
        // The display is the process's, shared by all contexts on it, hence never terminated.
        if (display_ == EGL_NO_DISPLAY)
            fail("eglGetPlatformDisplayEXT");
        if (egl_.Initialize(display_, nullptr, nullptr) == EGL_FALSE)
            fail("eglInitialize");
        if (!egl_.display_offers(display_, "EGL_KHR_surfaceless_context"))
            throw Error("the display lacks EGL_KHR_surfaceless_context");
        if (egl_.BindAPI(EGL_OPENGL_API) == EGL_FALSE)
            fail("eglBindAPI");
        const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (egl_.ChooseConfig(display_, wanted.data(), &config, 1, &count) == EGL_FALSE)
            fail("eglChooseConfig");
        if (count == 0)
            throw Error("the display has no configuration for desktop GL");
        for (const auto& [major, minor] : context_versions) {
            const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                                   major,
                                                   EGL_CONTEXT_MINOR_VERSION,
                                                   minor,
                                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                   EGL_NONE};
            context_ = egl_.CreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
            if (context_ != EGL_NO_CONTEXT)
                return;
        }
        fail("eglCreateContext, GL 3.3 core");
    }
    ~EglBackend() override { egl_.DestroyContext(display_, context_); }

    void make_current() override {
        if (egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE)
            fail("eglMakeCurrent");
    }
    void release() override { egl_.MakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    void* resolve(const char* name) override { return reinterpret_cast<void*>(egl_.GetProcAddress(name)); }

  private:
    [[noreturn]] void fail(const char* call) const {
        throw Error(fmt::format("{} failed, EGL error {:#06x}", call, egl_.GetError()));
    }

    Egl egl_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

/// libEGL passes over a vendor's library that does not load, and does not say so.
std::string broken_vendors() { return SharedLibrary::broken({"libEGL_mesa.so.0", "libEGL_nvidia.so.0"}); }

} // namespace

std::unique_ptr<ContextBackend> make_egl_surfaceless_context() {
    const Egl egl;
    if (egl.GetPlatformDisplayEXT == nullptr || !egl.client_offers("EGL_MESA_platform_surfaceless"))
        throw Error("libEGL lacks EGL_MESA_platform_surfaceless" + broken_vendors());
    return std::make_unique<EglBackend>(
        egl, egl.GetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
}

std::unique_ptr<ContextBackend> make_egl_device_context(int device) {
    const Egl egl;
    if (egl.GetPlatformDisplayEXT == nullptr || !egl.client_offers("EGL_EXT_platform_device"))
        throw Error("libEGL lacks EGL_EXT_platform_device" + broken_vendors());
    const std::vector<EGLDeviceEXT> devices = egl.devices();
    if (devices.empty())
        throw Error("EGL lists no device" + broken_vendors());
    const auto index = static_cast<std::size_t>(device);
    if (index >= devices.size())
        throw Error(fmt::format("there is no device {}; EGL lists 0 to {}", device, devices.size() - 1));
    return std::make_unique<EglBackend>(egl,
                                        egl.GetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[index], nullptr));
}

int egl_device_count() try { return static_cast<int>(Egl().devices().size()); } catch (const Error&) {
    return 0;
}

bool egl_device_is_hardware(int device) {
    const Egl egl;
    const std::vector<EGLDeviceEXT> devices = egl.devices();
    const auto index = static_cast<std::size_t>(device);
    if (index >= devices.size() || egl.QueryDeviceStringEXT == nullptr)
        return false;
    return !Egl::listed(egl.QueryDeviceStringEXT(devices[index], EGL_EXTENSIONS), "EGL_MESA_device_software");
}

} // namespace lockstep
