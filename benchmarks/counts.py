"""What KOKKOS styles launch and wait for, counted with kernel_counter.cpp."""

import json
import re

from machine import compile_here

LIBRARY = "kernel_counter.so"


def build(cache):
    """Path of the tool, or None where there is no compiler."""
    target = (cache / LIBRARY).absolute()
    made = compile_here("kernel_counter.cpp", target, "c++", "-O2", "-std=c++17", "-shared",
                        "-fPIC")
    return target if made else None


def short(label):
    """A kernel's label without template arguments that say nothing here."""
    reducer = re.match(r"CombinedFunctorReducer<(.*)", label)
    if reducer:
        depth, end = 0, 0
        for end, c in enumerate(reducer[1]):
            depth += (c in "<(") - (c in ">)")
            if depth < 0 or (depth == 0 and c == ","):
                break
        tag = re.search(r">/(?!.*>/)(.*)$", label)
        label = reducer[1][:end] + ("/" + tag[1] if tag else "")
    label = re.sub(r"(LAMMPS_NS|Kokkos|Foam)::(Impl::)?", "", label)
    return re.sub(r",? ?(OpenMP|Serial|Cuda|Device<[^<>]*>)(?=[,> ])", "", label).replace("<>", "")


def read(path):
    """Counts of one run, {(what, where, label): (count, seconds, bytes)}, and the most memory."""
    raw = json.loads(path.read_text())
    counts = {}

    def add(key, *values):
        counts[key] = tuple(a + b for a, b in zip(counts.get(key, (0, 0.0, 0)), values))

    for event in raw["kernels"]:
        add(("launch", event["device"], short(event["label"])), event["count"], event["seconds"], 0)
    for event in raw["fences"]:
        label = f"{short(event['label'])}; after {short(event['after'])}"
        add(("fence", event["device"], label), event["count"], event["seconds"], 0)
    for copy in raw["copies"]:
        add(("copy", copy["direction"], short(copy["label"])), copy["count"], 0.0, copy["bytes"])
    return counts, raw["memory"]


def difference(more, less, times=1.0):
    """What `more` did beyond `less`, taken so many times."""
    result = {}
    for key, values in more.items():
        change = tuple(a - times * b for a, b in zip(values, less.get(key, (0, 0.0, 0))))
        if abs(change[0]) > 1e-9:
            result[key] = change
    return result


def totals(counts, divisor):
    """Launches, fences and copies of `counts`, divided; the host's own ones of a program that has
    a device are apart."""
    launches = {}
    for (what, where, _), (count, _, _) in counts.items():
        if what == "launch":
            launches[where] = launches.get(where, 0) + count
    device = max(launches, key=launches.get, default=None)
    total = {"device": device, "launches": 0.0, "fences": 0.0, "host launches": 0.0, "copies": {},
             "copied bytes": {}}
    for (what, where, _), (count, _, size) in counts.items():
        if what == "launch":
            total["launches" if where == device else "host launches"] += count / divisor
        elif what == "fence" and where == device:
            total["fences"] += count / divisor
        elif what == "copy":
            total["copies"][where] = total["copies"].get(where, 0.0) + count / divisor
            total["copied bytes"][where] = total["copied bytes"].get(where, 0.0) + size / divisor
    return total


def listed(counts, divisor, bubbles):
    """The same label by label: [{what, where, label, count, ns per bubble, bytes}]."""
    rows = [{"what": what, "where": where, "label": label, "count": count / divisor,
             "ns": 1e9 * seconds / divisor / bubbles, "bytes": size / divisor}
            for (what, where, label), (count, seconds, size) in counts.items()]
    order = {"launch": 0, "fence": 1, "copy": 2}
    return sorted(rows, key=lambda row: (order[row["what"]], -row["ns"], -row["count"]))
