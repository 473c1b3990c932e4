// What head.schema tells of the state: buffers and images, their fields (crosscheck/scene/schema_json.cpp).

export const fieldName = (name) => name.replaceAll("_", " ");

// "position.x", "collide time": the components of an item, in the order in which they are stored.
export const componentNames = ({ fields }) =>
  fields.flatMap(({ name, components }) =>
    components === 1 ? [fieldName(name)] : Array.from({ length: components }, (_, c) => `${fieldName(name)}.${"xyzw"[c]}`),
  );
