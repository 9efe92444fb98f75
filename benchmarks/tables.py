"""The table that run.py shows: its columns are explained in doc/performance.rst."""

NAMES = {"foam": "durian/foam", "relax": "springs alone", "hooke": "gran/hooke",
         "history": "gran/hooke/history"}


def memory_per_bubble(report, run, key):
    """Bytes per bubble of the process (rss) or the device, from the smallest packing to this."""
    small = min((r for r in report["runs"] if all(r[k] == run[k] for k in
                                                  ("configuration", "what", "scene"))),
                key=lambda r: r["bubbles"])
    more = run["bubbles"] - small["bubbles"]
    return 2**20 * (run[key] - small[key]) / more if more > 0 else None


def cell(value, width, form=".1f"):
    return f"{'-':>{width}s}" if value is None else f"{value:{width}{form}}"


def digits(value):
    """A format with three digits that matter."""
    return ".3f" if value < 1 else ".2f" if value < 10 else ".1f" if value < 100 else ".0f"


def table(report):
    lines = [f"{report['machine']}" + (f", {report['gpu']}" if report["gpu"] else ", no GPU"),
             "memory bandwidth (triad): " + (", ".join(
                 f"{value:.0f} GB/s " + ("GPU" if key == "cuda" else f"{key} thread"
                                         + "s" * (key != "1"))
                 for key, value in report["bandwidth"].items() if value) or "not measured")]
    for scene in dict.fromkeys(run["scene"] for run in report["runs"]):
        runs = [run for run in report["runs"] if run["scene"] == scene]
        lines += ["", f"{scene.upper()}, gas fraction {runs[0]['phi']}: "
                  "nanoseconds per bubble and evaluation",
                  " bubbles  what               on       whole    pair  modify   neigh    comm"
                  "   other |  evals/tau   s/tau | bytes   floor  share | B/bubble  device"]
        for run in sorted(runs, key=lambda r: (r["nominal"], list(NAMES).index(r["what"]))):
            s = run["split"]
            ns = [run["ns"], s["Pair"], s["Modify"], s["Neigh"], s["Comm"], s["Other"] + s["Output"]]
            floor = run.get("floor ns")
            lines.append(
                f"{run['bubbles']:8.0f}  {NAMES[run['what']]:18s} {run['configuration']:6s}" +
                "".join(f"{value:8{digits(value)}}" for value in ns) + " | " +
                cell(run.get("evaluations per tau"), 10, ".0f") +
                cell(run.get("seconds per tau"), 8, digits(run.get("seconds per tau") or 0)) + " | "
                + cell(run.get("bytes"), 5, ".0f") + cell(floor, 8, digits(floor or 0)) +
                cell(floor and 100 * floor / run["ns"], 6, ".0f") + ("%" if floor else " ") + " | "
                + cell(memory_per_bubble(report, run, "rss"), 8, ".0f")
                + cell(memory_per_bubble(report, run, "device memory") if run["device memory"]
                       else None, 8, ".0f"))
        for other in report["others"]:
            if other["scene"] == scene:
                lines.append(f"{other['bubbles']:8.0f}  {other['label']:25s}"
                             f"{other['ns']:8{digits(other['ns'])}}")
    if report["counts"]:
        lines += ["", "Kokkos, per evaluation without list builds (per list build)",
                  "scene  what               on        launches      fences     "
                  "fills  copies on device  device to host  host to device"]
        for row in report["counts"]:
            lines.append(counts_line(row))
    for row in report["counts"]:
        if row["what"] == "foam":
            lines += ["", f"{row['scene']} {row['configuration']}: per evaluation, without list "
                      "builds"]
            lines += label_lines(row["labels"])
    for row in report["kernels"]:
        lines += ["", f"{row['scene']} {row['configuration']}, {row['bubbles']:.0f} bubbles: per "
                  "evaluation, list builds included; ns per bubble, waiting for each kernel"]
        lines += label_lines(row["labels"])
    if report["notes"]:
        lines += ["", *dict.fromkeys(report["notes"])]
    return "\n".join(lines)


def label_lines(labels):
    lines = []
    for label in labels:
        if label["what"] == "fence" or label["count"] < 0.004:
            continue
        time_of = f"{label['ns']:8.3f} ns" if label["ns"] else ""
        size = f"  {label['bytes']:.0f} B" if label["bytes"] else ""
        where = label["where"] + ": " if label["what"] == "copy" else ""
        lines.append(f"  {label['count']:7.2f} {time_of}  {where}{label['label'][:100]}{size}")
    return lines


def counts_line(row):
    steady, build = row["steady"], row.get("per build")

    def shown(get, width):
        text = f"{get(steady):.2f}" + (f" ({get(build):.0f})" if build else "")
        return f"{text:>{width}s}"

    def copies(choose):
        return lambda total: sum(n for where, n in total["copies"].items() if choose(where))

    def host(space):
        return space == "Host" or space.endswith("Pinned")

    def across(source, target):
        return copies(lambda where: not where.startswith("fill") and
                      host(where.split(" to ")[0]) == source and
                      host(where.split(" to ")[1]) == target)

    on_host = steady["device"] in ("OpenMP", "Serial", "Threads", None)
    return (f"{row['scene']:6s} {NAMES[row['what']]:18s} {row['configuration']:8s}"
            + shown(lambda t: t["launches"], 10) + shown(lambda t: t["fences"], 12)
            + shown(copies(lambda where: where.startswith("fill")), 10)
            + shown(across(on_host, on_host), 18)
            + (f"{'-':>16s}{'-':>16s}" if on_host else
               shown(across(False, True), 16) + shown(across(True, False), 16)))
