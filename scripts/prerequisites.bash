# What scripts/demo and scripts/test share: they find out what is missing, and install that and nothing else.
#
# Sourced, not run. Debian and its relatives get packages installed; elsewhere the packages are named and the script ends.

say() { printf '%s: %s\n' "$(basename "$0")" "$*" >&2; }

fail() {
    say "$*"
    exit 1
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        fail "this needs root and there is no sudo: run as root: $*"
    fi
}

# Installs the Debian packages given after the reason for them.
install() {
    local reason=$1
    shift
    [ $# -gt 0 ] || return 0
    if ! command -v apt-get >/dev/null; then
        say "$reason, which this system's package manager has under names like these of Debian: $*"
        fail "install them and run this again"
    fi
    say "$reason: installing $*"
    # A fresh machine has no lists of packages yet, an old one may have stale ones.
    if ! apt_install "$@" >/dev/null 2>&1; then
        as_root apt-get -q update >&2
        apt_install "$@" >&2 || fail "apt-get could not install $*: see its message above"
    fi
}

apt_install() { as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install "$@"; }

# Rust, and the linker that it calls.
need_rust() {
    if ! command -v cargo >/dev/null; then
        # rustup installs here; a shell that was open meanwhile does not know it yet.
        PATH="${CARGO_HOME:-$HOME/.cargo}/bin:$PATH"
        command -v cargo >/dev/null || fail "Rust is missing: install it as https://rustup.rs says, then run this again"
    fi
    if ! command -v cc >/dev/null; then
        case $(uname -s) in
            Darwin) fail "the linker is missing: run 'xcode-select --install', then this again" ;;
            *) install "Rust needs a linker" gcc libc6-dev ;;
        esac
    fi
}

# The program as it was just built. Not by way of `cargo run` alone: after `cargo test` that would build every dependency again, with
# the features that the tests do without.
rilievo() {
    local program="${CARGO_TARGET_DIR:-target}/debug/rilievo"
    if [ -x "$program" ]; then "$program" "$@"; else cargo run --quiet --locked -- "$@"; fi
}

# An adapter: asks the program itself. Only Linux keeps its drivers in packages of their own.
need_adapter() {
    if rilievo adapters "$@" >/dev/null 2>&1; then
        return 0
    fi
    if [ "$(uname -s)" = Linux ]; then
        install "there is no usable graphics adapter, Mesa's drivers have one in software" libvulkan1 mesa-vulkan-drivers
    fi
    rilievo adapters "$@" >&2 || fail "there is still no usable graphics adapter: see the message above"
}

# The libraries that a window loads when it opens.
need_window_libraries() {
    [ "$(uname -s)" = Linux ] || return 0
    local missing=() library package
    while read -r library package; do
        has_library "$library" || missing+=("$package")
    done <<'LIST'
libX11-xcb.so.1 libx11-xcb1
libXcursor.so.1 libxcursor1
libXi.so.6 libxi6
libXrandr.so.2 libxrandr2
libxkbcommon-x11.so.0 libxkbcommon-x11-0
LIST
    if [ -n "${WAYLAND_DISPLAY:-}" ]; then
        has_library libwayland-client.so.0 || missing+=(libwayland-client0)
        has_library libxkbcommon.so.0 || missing+=(libxkbcommon0)
    fi
    install "a window needs libraries" ${missing[@]+"${missing[@]}"}
}

has_library() {
    # Not in everyone's PATH.
    local ldconfig
    ldconfig=$(PATH="$PATH:/sbin:/usr/sbin" command -v ldconfig) || return 1
    # No `grep -q`: it would close the pipe early, which pipefail takes for a failure.
    "$ldconfig" -p | grep -F "	$1 " >/dev/null
}

# The programs given as pairs of a name and its Debian package.
need_programs() {
    local reason=$1 missing=()
    shift
    while [ $# -gt 0 ]; do
        command -v "$1" >/dev/null || missing+=("$2")
        shift 2
    done
    install "$reason" ${missing[@]+"${missing[@]}"}
}

has_display() {
    case $(uname -s) in
        Linux | *BSD) [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ] ;;
        *) true ;;
    esac
}
