#!/bin/sh
# Runs a peer of each vendor in a network namespace of their own, whose default route is a card that leads nowhere, and reads what the card was given to send.
# usage: loopback_only.sh INTEROP_PEER
set -eu
if [ "${2:-}" != inside ]; then
  unshare -rn true 2>/dev/null || { echo "skipped: network namespaces are not permitted here"; exit 77; }
  exec unshare -rn "$0" "$1" inside
fi
peer=$1
ip link set lo up
ip link add card type dummy 2>/dev/null || ip link add card type veth peer name hole 2>/dev/null ||
  ip tuntap add dev card mode tap 2>/dev/null || { echo "skipped: no network card can be made here"; exit 77; }
ip link set hole up 2>/dev/null || true
echo 1 > /proc/sys/net/ipv6/conf/card/disable_ipv6 2>/dev/null || true
ip addr add 10.99.0.1/24 dev card
ip link set card up
ip route add default dev card
sent_by_card() { ip -s link show card | awk 'found { print $2; exit } /TX:/ { found = 1 }'; }
run() { (sleep 3) | "$peer" "$@" samples > /dev/null; }

before=$(sent_by_card)
run fast 120 &
first=$!
run cyclone 120 &
second=$!
sleep 1
groups=$(awk '$1 ~ /^[0-9A-F]+$/ && length($1) == 8 && $1 != "010000E0" { print $1 }' /proc/net/igmp)
wait $first
wait $second
after=$(sent_by_card)
[ "$after" = "$before" ] || { echo "the network card was given $((after - before)) packets"; exit 1; }
[ -z "$groups" ] || { echo "multicast groups were joined: $groups"; exit 1; }

# The other way round, so that this test can fail: with the vendor's own defaults packets do go out.
CYCLONEDDS_URI='<CycloneDDS/>' run cyclone 121
control=$(sent_by_card)
[ "$control" -gt "$after" ] || { echo "the control run sent nothing: this test sees nothing"; exit 1; }
echo "nothing left the loopback; the control run sent $((control - after)) packets"
