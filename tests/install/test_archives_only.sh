#!/usr/bin/env bash
# Built with BUILD_SHARED_LIBS off there are no shared libraries, and programs link by pkg-config and find_package(gough) as with them.
# Where a file is compiled with the same words in this build, its object is taken from there.
source "$(dirname "$0")/use.sh"
: "${BUILD:?}" "${SOURCE:?}"
if nm -u "$BUILD/libgough.a" 2>/dev/null | grep -q __asan; then echo "skipped: built with sanitizers"; exit 77; fi
only=$scratch/only
# a call of the compiler without quotes, the name of the compiler and that of the folder of the build
ninja -C "$BUILD" -t commands gough_archive 2>/dev/null | grep -- ' -c ' | tr -d "\\\\\"'" | sed "s|$BUILD|BUILD|g; s|^[^-]* -|-|" >"$scratch/known" || true
cat >"$scratch/launcher" <<END
#!/usr/bin/env bash
call=\${*//[\\\\\"\']/}
call=-\${call#* -}
call=\${call//"$only"/BUILD}
object=\${call##* -o }
object=\${object%% *}
if [[ -e $BUILD/\$object ]] && grep -qxF -- "\$call" "$scratch/known"; then
    echo "\$object" >>"$scratch/taken"
    exec cp "$BUILD/\$object" "\$object"
fi
exec "\$@"
END
chmod +x "$scratch/launcher"
touch "$scratch/taken"
options=()
for name in CMAKE_BUILD_TYPE CMAKE_C_COMPILER CMAKE_C_FLAGS GOUGH_WERROR; do
    value=$(sed -n "s/^$name:[A-Z]*=//p" "$BUILD/CMakeCache.txt")
    options+=("-D$name=$value")
done
cmake -S "$SOURCE" -B "$only" -G Ninja "${options[@]}" -DBUILD_SHARED_LIBS=OFF -DGOUGH_TESTS=OFF -DGOUGH_PAGE=OFF -DGOUGH_PYTHON=OFF \
    -DGOUGH_MPI=OFF -DCMAKE_C_COMPILER_LAUNCHER="$scratch/launcher" >"$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
cmake --build "$only" --target gough_archive gough_shared gough_analyse_shared gough_files_shared >"$scratch/log" 2>&1 || { tail -30 "$scratch/log"; exit 1; }
echo "$(wc -l <"$scratch/taken") of $(ninja -C "$only" -t commands gough_archive | grep -c -- ' -c ') objects were taken from this build"
DESTDIR="" cmake --install "$only" --prefix "$scratch/prefix" --component development >/dev/null
shared=$(find "$only" "$scratch/prefix" -name '*.so*')
[[ -z $shared ]] || { echo "shared libraries although BUILD_SHARED_LIBS is off: $shared"; exit 1; }
link_programs "$scratch/prefix"
for program in by-pkg-config files user/build/program user/build/files; do
    if readelf -d "$scratch/$program" | grep -q 'NEEDED.*libgough'; then echo "$program needs a shared library of gough"; exit 1; fi
done
