// What points are sorted by: no two are alike but for padding.
struct Key {
    uint time, order, of; // of birth, as its bits; in the frame; the slot
};
layout(std430) buffer Keys { Key keys[]; };

uniform uint u_FirstKey, u_Keys;
