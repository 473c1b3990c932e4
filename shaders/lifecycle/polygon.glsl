// What a sprite is drawn as, in shares of its side; a strip. Of a scene with a polygon the host makes this file anew, a fan.
vec2 corner_of_sprite(int corner) { return vec2((corner & 1) != 0 ? 1.0 : 0.0, (corner & 2) != 0 ? 1.0 : 0.0); }
