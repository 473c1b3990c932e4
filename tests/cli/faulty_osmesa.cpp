// A library between the program and OSMesa that makes mistakes of a driver on purpose: LOCKSTEP_TEST_FAULT holds lines
// of GLSL that each shader gets behind its #version, such as `#define inversesqrt(x) (1.0001 * inversesqrt(x))`.
// Loaded by LOCKSTEP_OSMESA_LIBRARY.

#include <cstdlib>
#include <cstring>
#include <string>

#include <dlfcn.h>

namespace {

void* osmesa() {
    static void* const library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    return library;
}

template <class Function> Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(osmesa(), name));
}

using ShaderSource = void(unsigned shader, int count, const char* const* strings, const int* lengths);
ShaderSource* real_shader_source = nullptr;

void shader_source(unsigned shader, int count, const char* const* strings, const int* lengths) {
    std::string text;
    for (int k = 0; k < count; ++k)
        text += lengths != nullptr && lengths[k] >= 0 ? std::string(strings[k], static_cast<std::size_t>(lengths[k]))
                                                      : std::string(strings[k]);
    const char* fault = std::getenv("LOCKSTEP_TEST_FAULT");
    if (const std::size_t version = text.find("#version"); fault != nullptr && version != std::string::npos)
        text.insert(text.find('\n', version) + 1, std::string(fault) + "\n#line 2\n");
    const char* all = text.c_str();
    real_shader_source(shader, 1, &all, nullptr);
}

} // namespace

extern "C" {

void* OSMesaCreateContextAttribs(const int* attributes, void* share) {
    return real<void*(const int*, void*)>("OSMesaCreateContextAttribs")(attributes, share);
}

void OSMesaDestroyContext(void* context) { real<void(void*)>("OSMesaDestroyContext")(context); }

unsigned char OSMesaMakeCurrent(void* context, void* pixels, unsigned type, int width, int height) {
    return real<unsigned char(void*, void*, unsigned, int, int)>("OSMesaMakeCurrent")(context, pixels, type, width,
                                                                                      height);
}

void* OSMesaGetProcAddress(const char* name) {
    void* const found = real<void*(const char*)>("OSMesaGetProcAddress")(name);
    if (std::strcmp(name, "glShaderSource") != 0)
        return found;
    real_shader_source = reinterpret_cast<ShaderSource*>(found);
    return reinterpret_cast<void*>(&shader_source);
}
}
