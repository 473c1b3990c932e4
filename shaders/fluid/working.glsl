// What a filter works on: depths of the view, or the stored numbers themselves. Needs source.glsl.

#if FILTER == FILTER_NARROW_RANGE || FILTER == FILTER_CURVATURE_FLOW || FILTER_CONSTANTS == FILTER_CONSTANTS_METRIC
float working_of(float stored) { return z_of(stored); }
float stored_of_working(float z) { return stored_of(z); }
#else
float working_of(float stored) { return stored; }
float stored_of_working(float depth) { return on_codes(depth); }
#endif
