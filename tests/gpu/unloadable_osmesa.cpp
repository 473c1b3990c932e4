extern "C" {
void of_another_release();
void* OSMesaCreateContextAttribs(const int*, void*) {
    of_another_release();
    return nullptr;
}
}
