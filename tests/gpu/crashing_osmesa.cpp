#include <cstdlib>

extern "C" {
void* OSMesaCreateContextAttribs(const int*, void*) { std::abort(); }
void OSMesaDestroyContext(void*) {}
unsigned char OSMesaMakeCurrent(void*, void*, unsigned, int, int) { return 0; }
void* OSMesaGetProcAddress(const char*) { return nullptr; }
}
