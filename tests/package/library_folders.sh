# Sourced by tests: where the loader looks for the libraries of programs.

# Prints each program and library in the folders whose RPATH or RUNPATH has an entry that is neither absolute nor relative
# to the program, with that path. An empty entry is the current folder.
unfit_library_folders() {
    find "$@" -type f \( -perm -u+x -o -name '*.so*' \) -print0 | while IFS= read -r -d '' file; do
        [ "$(head -c 4 "$file" | tail -c 3)" = ELF ] || continue
        LC_ALL=C readelf -d "$file" 2>/dev/null | sed -nE 's/.*\((RPATH|RUNPATH)\).*\[(.*)\]$/\2/p' | while IFS= read -r path; do
            printf '%s\n' "$path" | tr : '\n' | grep -qvE '^(/|\$ORIGIN(/|$))' && printf '%s: [%s]\n' "$file" "$path"
        done
    done || true
}

# Makes files in FOLDER with the names of all libraries that PROGRAM loads; none of them can be loaded.
plant_libraries() { # PROGRAM FOLDER
    ldd "$1" | awk '$2 == "=>" { print $1 }' | while read -r library; do : >"$2/$library"; done
}
