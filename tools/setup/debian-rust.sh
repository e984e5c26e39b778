#!/usr/bin/env bash
# Makes a Rust toolchain with wasm32-unknown-unknown in the folder DEST, for Debian machines that
# reach Debian's packages and cargo's registry but not rustup's server:
#
#   debian-rust.sh DEST
#
# rustc, cargo and clippy come from the packages of rustc-web, which are unpacked, not installed;
# std for wasm32 is compiled from rust-web-src the way rustc's own build does it. Needs no root,
# changes nothing outside of DEST. With DEST/bin first on the PATH cargo builds for wasm32.
set -euo pipefail

fail() { echo "debian-rust: $*"; exit 1; }
note() { echo "[$SECONDS s] $*"; }

dest=$(cd "${1:?usage: debian-rust.sh DEST}" && pwd)
work=$dest/work
target=wasm32-unknown-unknown
mkdir -p "$work/debs" "$work/root"

for program in apt-get apt-cache dpkg dpkg-deb tar gcc ldd; do
  command -v "$program" > /dev/null || fail "it needs $program"
done
case $(dpkg --print-architecture) in
  amd64) arch=x86_64 ;;
  arm64) arch=aarch64 ;;
  *) fail "there is no recipe for $(dpkg --print-architecture)" ;;
esac
host=$arch-unknown-linux-gnu
multiarch=$arch-linux-gnu

# --- Which packages -----------------------------------------------------------------------------

version=$(apt-cache policy rustc-web | sed -n 's/^ *Candidate: *//p')
[ -n "$version" ] && [ "$version" != '(none)' ] \
  || fail "apt knows no rustc-web: \`apt-get update\` as root may help, on Debian 12"
release=$(cut -d. -f1-2 <<< "$version")
llvm=$(apt-cache depends "libstd-rust-web-$release" | sed -n 's/.*Depends: libllvm\([0-9]*\).*/\1/p' | head -n 1)
[ -n "$llvm" ] || fail "apt does not say which LLVM libstd-rust-web-$release uses"

packages=(rustc-web cargo-web rust-web-clippy rust-web-src
  "libstd-rust-web-$release" libstd-rust-web-dev "libllvm$llvm" "lld-$llvm")
# The shared libraries that installing these would bring along (libgit2 for cargo, for example).
mapfile -t libraries < <(
  apt-get -s install --no-install-recommends rustc-web cargo-web "lld-$llvm" 2> /dev/null \
    | awk '$1 == "Inst" && $2 ~ /^lib/ { print $2 }')
mapfile -t packages < <(printf '%s\n' "${packages[@]}" "${libraries[@]}" | sort -u)
note "rustc-web $version with LLVM $llvm: ${packages[*]}"

# --- Download and unpack ------------------------------------------------------------------------

(cd "$work/debs" && apt-get download -q "${packages[@]}") || fail "apt could not download the packages"
note "downloaded $(du -sh "$work/debs" | cut -f 1)"

for deb in "$work"/debs/*.deb; do
  case $deb in
    # Of rustc's source only std is needed.
    */rust-web-src_*)
      dpkg-deb --fsys-tarfile "$deb" | tar -x -C "$work/root" --wildcards './usr/src/rustc-*/library' ;;
    *) dpkg-deb -x "$deb" "$work/root" ;;
  esac
done
note "unpacked"

# --- Lay out ------------------------------------------------------------------------------------

usr=$work/root/usr
mkdir -p "$dest/bin" "$dest/libexec" "$dest/lib/rustlib/src/rust"
# rustc takes its sysroot from the place of librustc_driver, so that has to be in DEST/lib.
cp -a "$usr/lib/$multiarch"/lib*.so* "$dest/lib/"
cp -a "$usr/lib/rustlib/$host" "$dest/lib/rustlib/"
mv "$usr"/src/rustc-*/library "$dest/lib/rustlib/src/rust/"

for program in rustc rustdoc cargo cargo-clippy clippy-driver; do
  install -m 755 "$usr/bin/$program" "$dest/libexec/$program"
  cat > "$dest/bin/$program" << 'WRAPPER'
#!/bin/sh
here=$(dirname "$(readlink -f "$0")")
LD_LIBRARY_PATH=$here/../lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export LD_LIBRARY_PATH
exec "$here/../libexec/$(basename "$0")" "$@"
WRAPPER
  chmod 755 "$dest/bin/$program"
done

# rustc looks for a linker of this name; lld acts by the name it is called by.
mkdir -p "$dest/lib/rustlib/$host/bin"
install -m 755 "$usr/lib/llvm-$llvm/bin/lld" "$dest/lib/rustlib/$host/bin/rust-lld"

missing=$(
  for program in "$dest"/libexec/* "$dest/lib/rustlib/$host/bin/rust-lld"; do
    LD_LIBRARY_PATH=$dest/lib ldd "$program"
  done | awk '/not found/ { print $1 }' | sort -u | tr '\n' ' ')
[ -z "$missing" ] || fail "these shared libraries are missing: $missing"
note "laid out $("$dest/bin/rustc" --version)"

# --- std for wasm32 -----------------------------------------------------------------------------

# The caller's cargo and rustc settings are not for this build. The profile `dist` keeps bitcode
# in the libraries, without which `lto = true` would not reach into std.
(
  cd "$dest/lib/rustlib/src/rust/library"
  unset RUSTC RUSTDOC RUSTC_WRAPPER RUSTC_WORKSPACE_WRAPPER RUSTUP_TOOLCHAIN CARGO_ENCODED_RUSTFLAGS \
    CARGO_BUILD_TARGET CARGO_BUILD_RUSTC CARGO_BUILD_RUSTFLAGS "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS"
  export PATH="$dest/bin:$PATH" RUSTC_BOOTSTRAP=1 RUSTFLAGS=-Zforce-unstable-if-unmarked \
    __CARGO_DEFAULT_LIB_METADATA=developable
  cargo build --quiet --locked --manifest-path sysroot/Cargo.toml --profile dist \
    --target "$target" --features panic-unwind,backtrace --target-dir "$work/std"
) || fail "std could not be compiled (it needs some crates from cargo's registry)"

lib=$dest/lib/rustlib/$target/lib
mkdir -p "$lib"
cp "$work/std/$target"/dist/deps/*.rlib "$lib/"
# An empty crate that only pulled in the others.
rm -f "$lib"/libsysroot-*.rlib
rm -rf "$work"
note "done: $(du -sh "$dest" | cut -f 1)"
