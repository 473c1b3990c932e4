#include "gpu/gl.hpp"

#include <fmt/format.h>

#include "gpu/driver_call.hpp"
#include "reference/model/error.hpp"

namespace lockstep::gl {
namespace {

/// A function of the driver's, which is a DriverCall while it runs. `Name` makes it one of its own.
template <class Name, class Function> struct Called;
template <class Name, class Result, class... Arguments> struct Called<Name, Result (*)(Arguments...)> {
    static inline Result (*driver)(Arguments...) = nullptr;
    static Result call(Arguments... arguments) {
        const DriverCall running(Name::text);
        return driver(arguments...);
    }
};

/// What is called for the driver's `address`; null for null.
template <class Name, class Function> Function called(void* address) {
    using Call = Called<Name, Function>;
    Call::driver = reinterpret_cast<Function>(address);
    return address != nullptr ? &Call::call : nullptr;
}

#define LOCKSTEP_GL_NAME(name, ...)                                                                                    \
    struct name##Name {                                                                                                \
        static constexpr const char* text = "gl" #name;                                                                \
    };
LOCKSTEP_GL_CORE(LOCKSTEP_GL_NAME)
LOCKSTEP_GL_OPTIONAL(LOCKSTEP_GL_NAME)
#undef LOCKSTEP_GL_NAME

} // namespace

#define LOCKSTEP_GL_DEFINE(name, ...) decltype(&::gl##name) name = nullptr;
LOCKSTEP_GL_CORE(LOCKSTEP_GL_DEFINE)
LOCKSTEP_GL_OPTIONAL(LOCKSTEP_GL_DEFINE)
#undef LOCKSTEP_GL_DEFINE

bool offers(int major, int minor, const char* extension) {
    GLint has_major = 0;
    GLint has_minor = 0;
    GetIntegerv(GL_MAJOR_VERSION, &has_major);
    GetIntegerv(GL_MINOR_VERSION, &has_minor);
    if (has_major > major || (has_major == major && has_minor >= minor))
        return true;
    return has_extension(extension);
}

bool has_extension(std::string_view extension) {
    GLint count = 0;
    GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i)
        if (std::string_view(reinterpret_cast<const char*>(GetStringi(GL_EXTENSIONS, i))) == extension)
            return true;
    return false;
}

void load(const Resolver& resolve) {
    unload();
#define LOCKSTEP_GL_LOAD(function)                                                                                     \
    function = called<function##Name, decltype(function)>(resolve(function##Name::text));                              \
    if (function == nullptr)                                                                                           \
        throw Error(fmt::format("the GL library lacks {}, which GL 3.3 core has", function##Name::text));
    LOCKSTEP_GL_CORE(LOCKSTEP_GL_LOAD)
#undef LOCKSTEP_GL_LOAD
    // A resolver may hand out a stub for any name, so what the context offers decides.
#define LOCKSTEP_GL_LOAD(function, major, minor, extension)                                                            \
    if (offers(major, minor, extension))                                                                               \
        function = called<function##Name, decltype(function)>(resolve(function##Name::text));
    LOCKSTEP_GL_OPTIONAL(LOCKSTEP_GL_LOAD)
#undef LOCKSTEP_GL_LOAD
}

void unload() {
#define LOCKSTEP_GL_CLEAR(name, ...) name = nullptr;
    LOCKSTEP_GL_CORE(LOCKSTEP_GL_CLEAR)
    LOCKSTEP_GL_OPTIONAL(LOCKSTEP_GL_CLEAR)
#undef LOCKSTEP_GL_CLEAR
}

} // namespace lockstep::gl
