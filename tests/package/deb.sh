#!/usr/bin/env bash
# deb.sh BUILD PREFIX CC CONSUMER: Debian's packages of a build, unpacked into PREFIX, say what they need of each
# other, have the programs, and serve a program that is compiled with plait.pc.
set -euo pipefail
build=$1 prefix=$2 cc=$3 consumer=$4
rm -rf "$prefix"
mkdir -p "$prefix"
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$prefix/packages" >"$prefix/cpack.log" 2>&1 ||
    { cat "$prefix/cpack.log"; exit 1; }
for package in "$prefix"/packages/*.deb; do dpkg-deb -x "$package" "$prefix/root"; done

field() { dpkg-deb -f "$prefix"/packages/"$1"_*.deb "$2"; }
version=$(field libplait0 Version)
for package in libplait-dev plait-tools; do
    if ! field "$package" Depends | grep -qF "libplait0 (= $version)"; then
        echo "$package does not depend on libplait0 (= $version): $(field "$package" Depends)"
        exit 1
    fi
done
field libplait0 Depends | grep -q ocl-icd-libopencl1
dpkg-deb --ctrl-tarfile "$prefix"/packages/libplait0_*.deb | tar -xO ./shlibs | grep -F "libplait 0 libplait0"
tree=$(dirname "${BASH_SOURCE[0]}")/../..
grep -qF "\"version\": \"$version\"" "$tree/cmake/packages/vcpkg/plait/vcpkg.json"
for package in libplait0 libplait-dev plait-tools; do
    cmp "$prefix/root/usr/share/doc/$package/copyright" "$tree/LICENSE"
done

libraries=$prefix/root/usr/lib
LD_LIBRARY_PATH=$libraries "$prefix/root/usr/bin/plait-simulate" --version | grep -F "$version"
LD_LIBRARY_PATH=$libraries "$prefix/root/usr/bin/plait-groom" --help >/dev/null
bash "$(dirname "${BASH_SOURCE[0]}")/pkgconfig.sh" "$cc" "$prefix/root/usr" "$consumer"
