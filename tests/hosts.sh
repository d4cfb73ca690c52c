#!/bin/sh
# One solve among ranks on two hosts, which are network namespaces that this script makes, joined by
# a cable of their own: do they get the bits of one process? Needs root and Open MPI; ends with 77
# where the machine does not allow it. Touches nothing outside its namespaces.
#
#   tests/hosts.sh BUILD INPUT [options of distance]
set -eu
build=$(cd "$1" && pwd) input=$(realpath "$2")
shift 2
a=plexway-a-$$ b=plexway-b-$$
folder=$(mktemp -d)
finish() {
  ip netns del "$a" 2>/dev/null || true
  ip netns del "$b" 2>/dev/null || true
  rm -rf "$folder"
}
trap finish EXIT
skip() {
  echo "skipped: $1"
  exit 77
}
ip netns add "$a" 2>/dev/null || skip "no network namespaces here"
ip netns add "$b"
ip link add veth0 netns "$a" type veth peer name veth1 netns "$b" 2>/dev/null || skip "no veth here"
ip -n "$a" addr add 10.213.7.1/24 dev veth0
ip -n "$b" addr add 10.213.7.2/24 dev veth1
for end in "$a lo" "$b lo" "$a veth0" "$b veth1"; do
  ip -n "${end% *}" link set "${end#* }" up
done
# How mpirun begins processes on the other host, and that its name is another.
cat > "$folder/agent" <<AGENT
#!/bin/sh
while [ "\${1#-}" != "\$1" ]; do shift; done
shift
exec ip netns exec $b unshare -u sh -c "hostname $b; \$*"
AGENT
chmod +x "$folder/agent"
cd "$folder"
net=10.213.7.0/24
ip netns exec "$a" unshare -u sh -c 'hostname "$1"; shift; exec "$@"' sh "$a" \
  mpirun --allow-run-as-root --mca plm_rsh_agent "$folder/agent" --mca btl tcp,self \
  --mca btl_tcp_if_include $net --mca oob_tcp_if_include $net \
  -host 10.213.7.1:2,10.213.7.2:2 -n 4 sh -c 'hostname >> hosts; exec "$@"' sh \
  "$build/bin/plexway-mpi" distance "$input" --source vertex:0 --threads 1 "$@" --out ranks.npy
"$build/bin/plexway" distance "$input" --source vertex:0 --executor openmp --threads 1 "$@" \
  --out alone.npy --quiet
sort hosts | uniq -c
cmp alone.npy ranks.npy
echo "the same bits"
