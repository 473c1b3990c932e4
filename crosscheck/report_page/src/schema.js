// What head.schema says of the state: buffers and images, their fields (crosscheck/scene/schema_json.cpp).

export const fieldName = (name) => name.replaceAll("_", " ");

// "position.x", "collide time": the components of an item, in the order in which they are stored.
export const componentNames = ({ fields }) =>
  fields.flatMap(({ name, components }) =>
    components === 1 ? [fieldName(name)] : Array.from({ length: components }, (_, c) => `${fieldName(name)}.${"xyzw"[c]}`),
  );

const many = ({ item }) => `${item}s`;

// "every particle and texel": the items of all buffers and images.
export function everyItem({ resources }) {
  const names = [...new Set(resources.map(({ item }) => item))];
  return names.length < 2 ? names.join("") : `${names.slice(0, -1).join(", ")} and ${names.at(-1)}`;
}

// Of each buffer and image what a report's JSON calls its counts, and how a sentence does.
export const counts = ({ resources }) =>
  resources.map((resource) => ({
    ...resource,
    differing: `differing_${resource.key}s`,
    classes: `${resource.key}s`,
    cause: `${resource.key}_cause`,
    many: many(resource),
    states: resource.dimensions === 1 ? `${resource.item} states` : many(resource),
    state: resource.dimensions === 1 ? `${resource.item} state` : resource.item,
  }));

// "particle 17", "texel (3, 4)": an item that a report's JSON points at.
export function placeName({ resources }, place) {
  const { item, key } = resources.find((resource) => resource.key in place);
  return Array.isArray(place[key]) ? `${item} (${place[key].join(", ")})` : `${item} ${place[key]}`;
}
