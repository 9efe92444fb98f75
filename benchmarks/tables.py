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


def shown(value, width):
    """A number with three digits that matter."""
    if value is None:
        return f"{'-':>{width}s}"
    digits = 3 if value < 0.9995 else 2 if value < 9.995 else 1 if value < 99.95 else 0
    return f"{value:{width}.{digits}f}"


def table(report):
    bandwidth = [f"{value:.0f} GB/s " + ("GPU" if key == "cuda" else f"{key} thread" +
                                         "s" * (key != "1"))
                 for key, value in report["bandwidth"].items() if value]
    lines = [f"{report['machine']}, {report['gpu'] or 'no GPU'}",
             "memory bandwidth (triad): " + (", ".join(bandwidth) or "not measured")]
    for scene in dict.fromkeys(run["scene"] for run in report["runs"]):
        runs = sorted((run for run in report["runs"] if run["scene"] == scene),
                      key=lambda run: (run["nominal"], list(NAMES).index(run["what"])))
        lines += ["", f"{scene.upper()}, gas fraction {runs[0]['phi']:.2f}: nanoseconds per bubble "
                  "and evaluation", *time_lines(runs),
                  *(f"{other['bubbles']:8.0f}  {other['label']:24s}{shown(other['ns'], 8)}"
                    for other in report["others"] if other["scene"] == scene),
                  "", *cost_lines(report, runs)]
    if report["counts"]:
        lines += ["", "Kokkos: per evaluation without list builds (per list build)",
                  "scene  what               on     launches      fences       fills"
                  "   device     to host   to device", *map(counts_line, report["counts"])]
    lists = {}      # the same ones for several back ends stand there once
    for row in report["counts"]:
        if row["what"] == "foam":
            content = tuple(label_lines(row["labels"]))
            lists.setdefault(content, []).append(f"{row['scene']} {row['configuration']}")
    for content, where in lists.items():
        lines += ["", f"{', '.join(where)}: per evaluation, without list builds", *content]
    for row in report["kernels"]:
        lines += ["", f"{row['scene']} {row['configuration']}, {row['bubbles']:.0f} bubbles: per "
                  "evaluation, list builds included; ns per bubble, waiting for each kernel",
                  *label_lines([label for label in row["labels"] if label["what"] == "launch"], 16)]
    if report["notes"]:
        lines += ["", *dict.fromkeys(report["notes"])]
    return "\n".join(lines)


def time_lines(runs):
    lines = [" bubbles  what               on       whole    pair  modify   neigh    comm   other"]
    for run in runs:
        split = run["split"]
        ns = [run["ns"], *(split[name] for name in ("Pair", "Modify", "Neigh", "Comm")),
              split["Other"] + split["Output"]]
        lines.append(f"{run['bubbles']:8.0f}  {NAMES[run['what']]:18s} {run['configuration']:6s}" +
                     "".join(shown(value, 8) for value in ns))
    return lines


def cost_lines(report, runs):
    lines = [" bubbles  what           on     evals/tau     s/tau   bytes floor/ns   share"
             "  memory  device"]
    for run in runs:
        if "bytes" not in run:
            continue
        floor = run.get("floor ns")
        per_tau, memory = run.get("evaluations per tau"), memory_per_bubble(report, run, "rss")
        device = run["device memory"] and memory_per_bubble(report, run, "device memory")
        lines.append(
            f"{run['bubbles']:8.0f}  {NAMES[run['what']]:14s} {run['configuration']:6s}" +
            (f"{per_tau:10.0f}" if per_tau else f"{'-':>10s}") +
            shown(run.get("seconds per tau"), 10) + f"{run['bytes']:8.0f}" + shown(floor, 9) +
            (f"{100 * floor / run['ns']:7.0f}%" if floor else f"{'-':>8s}") +
            "".join(f"{value:8.0f}" if value else f"{'-':>8s}" for value in (memory, device)))
    return lines


def label_lines(labels, most=None):
    lines = []
    for label in labels[:most]:
        if label["count"] < 0.004:
            continue
        time_of = f"{label['ns']:8.3f} ns" if label["ns"] else ""
        size = f"  {label['bytes']:.0f} B" if label["what"] == "copy" else ""
        where = {"launch": "", "fence": "waits: ",
                 "copy": f"copy {label['where']}: "}[label["what"]]
        lines.append(f"  {label['count']:7.2f} {time_of}  {where}{label['label'][:90]}{size}")
    return lines


def counts_line(row):
    steady, build = row["steady"], row.get("per build")

    def on_host(space):
        return space == "Host" or space.endswith("Pinned")

    def copies(total, chosen):
        return sum(n for where, n in total["copies"].items() if chosen(where))

    def fill(where):
        return where.startswith("fill")

    def across(source, target):
        def chosen(where):
            spaces = where.split(" to ")
            return not fill(where) and [on_host(space) for space in spaces] == [source, target]
        return lambda total: copies(total, chosen)

    host = steady["device"] in ("OpenMP", "Serial", "Threads", None)
    columns = [(lambda total: total["launches"], 12), (lambda total: total["fences"], 12),
               (lambda total: copies(total, fill), 12), (across(host, host), 9)]
    if not host:
        columns += [(across(False, True), 12), (across(True, False), 12)]
    line = f"{row['scene']:6s} {NAMES[row['what']]:18s} {row['configuration']:5s}"
    for figure, width in columns:
        text = f"{figure(steady):.2f}" + (f" ({figure(build):.0f})" if build else "")
        line += f"{text:>{width}s}"
    return line + (f"{'-':>12s}{'-':>12s}" if host else "")
