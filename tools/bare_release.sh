# Sourced after tools/setup.sh: a release of Debian in a folder of its own, and commands there. As root; needs debootstrap.
# shellcheck shell=bash
certificates=/etc/certificates-of-the-machine.crt

# leave_release <root>: nothing stays mounted there.
leave_release() {
  local place
  # Deepest first; what is mounted must be gone before anything is removed.
  while read -r place; do umount --lazy "$place"; done < <(awk -v root="$1/" 'index($2, root) == 1 { print $2 }' /proc/mounts | sort -r)
}

# enter_release <root>: what commands there need of this machine.
enter_release() {
  mount -t proc proc "$1/proc"
  mount --rbind --make-rslave /dev "$1/dev"
  cp /etc/resolv.conf "$1/etc/"
  # Behind a proxy that signs again, the certificates of this machine are needed; in their usual place the package
  # ca-certificates would replace them.
  [[ ! -r /etc/ssl/certs/ca-certificates.crt ]] || cp /etc/ssl/certs/ca-certificates.crt "$1$certificates"
}

# install_release <release> <root> [<option of debootstrap>...]
install_release() {
  ((EUID == 0)) || fail "${0##*/} changes the root folder, which needs root."
  command -v debootstrap >/dev/null || fail 'debootstrap is missing (Debian package debootstrap).'
  local script=/usr/share/debootstrap/scripts/$1
  [[ -e $script ]] || script=/usr/share/debootstrap/scripts/sid # a release that is newer than debootstrap
  mkdir -p "$2"
  debootstrap --variant=minbase "${@:3}" "$1" "$2" "${DEBIAN_MIRROR:-http://deb.debian.org/debian}" "$script" >"$2.log" 2>&1 ||
    fail "debootstrap failed; $2.log says why."
  rm "$2.log"
}

# in_release <root> <folder there> <command>: with the settings of network and certificates of this machine alone.
in_release() {
  local -a settings=()
  local name
  for name in http_proxy https_proxy no_proxy PIP_INDEX_URL; do
    [[ ! -v $name ]] || settings+=("$name=${!name}")
  done
  for name in PIP_CERT NODE_EXTRA_CA_CERTS SSL_CERT_FILE; do
    [[ ! -v $name ]] || settings+=("$name=$certificates")
  done
  env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive "${settings[@]}" \
    chroot "$1" bash -c "cd $2 && $3" </dev/null
}
