#error "arithmetic exact: portable.glsl is not written yet"
