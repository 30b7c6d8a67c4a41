"""Tables of the pages, from what the program prints. Used by the pages' generated blocks.

    tables.py messages                  types of messages: fingerprint, bytes
    tables.py rejected SCENARIO         what the estimator rejected in a run of it, counted
    tables.py estimation SCENARIO...    errors of the estimate, one run a row
    tables.py seeds                     what was required and measured over seeds, of `ballbot reproduce --seeds N --json` on stdin
    tables.py faults                    the table of `ballbot hil --faults --json`, read from stdin
    tables.py budgets                   how full the buses of a bench are, classic and CAN FD, by `ballbot hil --budget`
    tables.py checks                    that of `ballbot hil --checks --json`
    tables.py identified                that of `ballbot identify --seeds N --json`
    tables.py margins                   how much a loop can take by `ballbot bode`, and what the robot took when it was measured
    tables.py commissioning             that of `ballbot hil --commission --faults --json`
    tables.py capture                   that of `ballbot capture --json`
    tables.py capture_limits            the bound of `ballbot capture --bound-only` with one limit of the robot changed, a row each
"""
import json
import subprocess
import sys

from lcm_wire import Wire

WHO = {
    "step_request": ("master to participant", "one per communication step"),
    "step_reply": ("participant to master", "one per request"),
    "sensor_frame": ("inside the reply; in the log", "log: the estimator's period"),
    "truth_frame": ("inside the reply; in the log", "log: 400 Hz"),
    "actuator_command": ("inside the request; in the log", "log: 400 Hz"),
    "state_estimate": ("log only", "400 Hz"),
    "plan_report": ("log only", "every plan"),
    "tick_digests": ("log only", "every 10 ms of simulated time"),
    "added_values": ("log only", "with the frame they were added to"),
}


def table(head, rows):
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")


def messages():
    wire = Wire("messages")

    def size(name):
        if name == "step_reply":
            return f"{wire.size(name, truth_count=1)} with truth, {wire.size(name)} without"
        if name == "added_values":
            return f"{wire.size(name)} + 8 per value; before these one message with each name, unit and words"
        if name == "tick_digests":
            return f"{wire.size(name)} + 4 per event + 4 per event and channel"
        return str(wire.size(name))

    table(["type", "fingerprint", "from, to", "how often", "bytes"],
          [[f"`{name}`", f"`{wire.fingerprint(name):016x}`", *WHO[name], size(name)] for name in WHO])
    print(f"\n`message_digest` of these definitions: `{wire.messageDigest():016x}`")


def summary(scenario):
    run = subprocess.run(["ballbot", "run", f"configs/scenarios/{scenario}.yaml", "--in-process", "--no-report",
                          "--quiet", "--json"], stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(run.stdout)


def rejected(scenario):
    table(["counted as", "times"], [[f"`{k}`", f"{v:.0f}"] for k, v in summary(scenario)["rejected"].items()])


def estimation(*scenarios):
    rows = []
    for name in scenarios:
        whole = summary(name)
        m = whole["metrics"]
        rows.append([f"`{name}`", f"{m['tilt_rms_deg']:.2g} degrees", f"{1e3 * m['velocity_rms_m_per_s']:.2g} mm/s",
                     f"{m['position_drift_percent']:.1g} %", f"{abs(m['yaw_error_deg']):.1g} degrees",
                     ", ".join(f"`{k}` {v:.0f}" for k, v in whole.get("rejected", {}).items()) or "nothing"])
    table(["scenario", "tilt rms", "velocity rms", "drift", "yaw at the end", "rejected"], rows)


def significant(value):
    """Three digits, without an exponent."""
    text = f"{float(f'{value:.3g}'):f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def seeds():
    rows = []
    for experiment in json.load(sys.stdin)["experiments"]:
        spread = experiment["seeds"]
        for number, required in enumerate(r for r in experiment["requirements"] if r["metric"] != "fell"):
            m = spread["metrics"][required["metric"]]
            rows.append([f"`{experiment['scenario']}`: {spread['passed']} of {spread['count']}" if number == 0 else "",
                         f"`{required['metric']}`", required["limit"],
                         f"{significant(m['median'])} ({significant(m['least'])} to {significant(m['largest'])})"])
    table(["experiment: seeds that pass", "metric", "limit", "median (range)"], rows)


def faults():
    rows = json.load(sys.stdin)["rows"]
    took = {}
    for r in rows:
        took.setdefault(r["name"], {})[r["runner"]] = r
    def cell(runs, runner):
        r = runs.get(runner)
        return "" if r is None else "on, and said" if r["torque_on"] else str(r["measured_cycles"])
    table(["fault", "reaction", "bound, cycles", "stepped took", "real time took"],
          [[name, (any_run := next(iter(runs.values())))["expected"], str(any_run["bound_cycles"]),
            cell(runs, "stepped"), cell(runs, "real time")] for name, runs in took.items()])
    print(f"\n{len(took)} faults in {len(rows)} trials, of which {sum(r['held'] for r in rows)} hold.")


def budgets():
    one_bus = ["--set", "drives=[" + ", ".join(f"{{node: {n}}}" for n in range(1, 7)) + "]"]

    def rates(mbps, buses):
        return ["--set", "buses=[" + ", ".join([f"{{address: none, fd: {{data_bitrate_kbps: {1000 * mbps}}}}}"] * buses) + "]",
                *(one_bus if buses == 1 else [])]

    def loads(file, arguments):
        run = subprocess.run(["ballbot", "hil", f"configs/hil/{file}.yaml", "--budget", "--json", *arguments],
                             stdout=subprocess.PIPE, text=True, check=True)
        return [f"{100 * b['nominal']:.0f} % ({100 * b['worst_stuffing']:.0f} %)" for b in json.loads(run.stdout)["buses"]]

    cases = [("classic, 400 Hz", "2", "one each", "bench", []),
             ("classic, 2.5 kHz", "2", "one each", "bench", ["--set", "cycle_us=400", "--set", "realtime={collect_us: 250, act_us: 300}"])]
    for mbps in (5, 8):
        for buses in (1, 2):
            for shared in (False, True):
                cases.append((f"CAN FD, data at {mbps} Mbit/s, 2.5 kHz", str(buses), "shared" if shared else "one each", "bench_fd",
                              [*rates(mbps, buses), "--set", f"shared_outputs={str(shared).lower()}"]))
    table(["1 Mbit/s", "buses", "torques of a bus", "load of bus 0 (most stuffing)", "bus 1: the arm"],
          [[name, buses, torques, *(loads(file, arguments) + ["-"])[:2]] for name, buses, torques, file, arguments in cases])


def checks():
    table(["check", "the message begins with", "reaction", "bound, cycles", "page"],
          [[f"`{c['name']}`", c["words"], c["reaction"], str(c["bound_cycles"]),
            f"[{c['page'].removesuffix('.md')}](troubleshooting/{c['page']})"]
           for c in json.load(sys.stdin)["checks"]])


def identified():
    found = json.load(sys.stdin)
    table(
        ("figure", "is", "found, mean", "sigma", "rms of error / sigma", f"within two sigma, of {found['seeds']}"),
        [
            (
                f["name"] + ", " + f["unit"],
                f"{f['truth']:.4g}",
                f"{f['mean']:.4g}",
                f"{f['sigma']:.2g}",
                f"{f['rms_z']:.2f}",
                str(f["within_two_sigma"]),
            )
            for f in found["figures"]
        ],
    )
    print()
    print(
        f"All together: {found['percent_within_two_sigma']:.1f} % within two sigma, rms {found['rms_z']:.2f}; "
        f"{found['percent_within_two_sigma_or_five_percent']:.1f} % within two sigma or 5 %."
    )


LAWS = {"MPC": "controller.kind=mpc", "MPC, paper's tracker": "controller.tracker.policy_feedback=0",
        "LQR": "controller.kind=lqr"}

# Where a small disturbance of the whole robot began to grow: sensors perfect, no friction. Delay of all six torques and of the
# wheels' [ms], gain at the wheels; bisected to a hundredth, of the gain to two.
ROBOT_GROWS = {
    ("MPC", 40): (15.0, 86.7, 0.513, 16.0),
    ("MPC, paper's tracker", 40): (28.4, 78.0, 0.583, 5.55),
    ("LQR", 40): (23.1, 88.5, 0.479, 11.3),
    ("MPC", 20): (18.7, 95.2, 0.590, 13.2),
    ("MPC, paper's tracker", 20): (38.8, 83.8, 0.673, 5.75),
    ("LQR", 20): (30.9, 97.1, 0.554, 11.7),
    ("MPC", 10): (41.6, 71.4, 0.890, 14.6),
    ("LQR", 10): (55.8, 88.2, 0.824, 13.4),
}


def marginsOf(law, bandwidth_Hz, more=()):
    run = subprocess.run(["ballbot", "bode", "configs/scenarios/balance.yaml", "--json", "--set", LAWS[law],
                          *[word for joint in ("wheel", "arm")
                            for word in ("--set", f"robot.actuators.{joint}.torque_bandwidth_Hz={bandwidth_Hz}")],
                          *[word for setting in more for word in ("--set", setting)]],
                         stdout=subprocess.PIPE, text=True, check=True)
    return json.loads(run.stdout)["margins"]


def margins():
    rows = []
    for bandwidth_Hz in (40, 20, 10):
        for law in LAWS:
            found = marginsOf(law, bandwidth_Hz, ("plant.fidelity.sensors=perfect", "plant.fidelity.friction=false"))
            robot = ROBOT_GROWS.get((law, bandwidth_Hz))
            row = [f"{bandwidth_Hz} Hz, {law}", f"{found['growth_rate_per_s']:.2f} /s"]
            if not found["stable"]:
                rows.append(row + ["", "", "", ""])
                continue
            linear = [found[k] for k in ("delay_margin_ms", "wheel_delay_margin_ms", "wheel_gain_margin_low", "wheel_gain_margin_high")]
            units = (" ms", " ms", "", "")
            rows.append(row + [f"{significant(a)}{unit}, {significant(b)}{unit}" for a, b, unit in zip(linear, robot, units)])
    table(["torque loop, law", "rate", "delay of all six: loop, robot", "of the wheels: loop, robot", "lowest gain: loop, robot",
           "highest: loop, robot"], rows)


def commissioning():
    table(["what is wrong", "found by the task", "before any torque"],
          [[r["name"], r["found_by"] or "(passes)", "no" if r["torque_was_on"] else "yes"]
           for r in json.load(sys.stdin)["rows"]])


def capture():
    found = json.load(sys.stdin)
    variants = list(dict.fromkeys(p["variant"] for p in found["pushes"]))
    by_direction = {}
    for p in found["pushes"]:
        by_direction.setdefault(p["direction_deg"], {})[p["variant"]] = p

    def survived(p):
        interval = f" ({p['low_N']:g} to {p['high_N']:g})" if p.get("low_N") is not None and p.get("high_N") is not None else ""
        return f"{p['survived_N']:g}{interval}"

    measured = "survived_N" in found["pushes"][0]
    table(["direction, degrees", *[f"{v}, N" for v in variants if measured], "bound, N", f"blind for {found['bound']['blind_ms']:g} ms, N"]
          + (["share of the bound"] if measured else []),
          [[f"{d:g}", *[survived(p[v]) for v in variants if measured], f"{p[variants[0]]['bound_known_N']:.1f}",
            f"{p[variants[0]]['bound_blind_N']:.1f}"] + ([f"{100 * p[variants[0]]['share_of_bound']:.0f} %"] if measured else [])
           for d, p in by_direction.items()])


def capture_limits(scenario):
    rows = []
    for name, changes in [("the shipped robot: 4 N m and 12 rad/s at a wheel", []),
                          ("a wheel's torque 6 N m", ["robot.wheel_torque_limit_Nm=6"]),
                          ("8.4 rad/s, as the MPC plans", ["robot.actuators.wheel.speed_limit_rad_per_s=8.4"]),
                          ("drives of any speed", ["plant.fidelity.speed_limit=false"]),
                          ("wheels that slip, friction 0.8", ["plant.fidelity.wheels=slipping"])]:
        run = subprocess.run(["ballbot", "capture", f"configs/scenarios/{scenario}.yaml", "--bound-only", "--quiet", "--json",
                              "--directions", "4", *[w for c in changes for w in ("--set", c)]],
                             stdout=subprocess.PIPE, text=True, check=True)
        by_direction = {p["direction_deg"]: p for p in json.loads(run.stdout)["pushes"]}
        rows.append([name, *[f"{by_direction[d][b]:.1f}" for b in ("bound_known_N", "bound_blind_N") for d in (0, 90)]])
    table(["with", "along x, N", "along y, N", "blind for 60 ms: along x", "along y"], rows)


if __name__ == "__main__":
    {"messages": messages, "rejected": rejected, "estimation": estimation, "seeds": seeds, "faults": faults, "budgets": budgets, "checks": checks,
     "identified": identified, "margins": margins, "commissioning": commissioning, "capture": capture,
     "capture_limits": capture_limits}[sys.argv[1]](*sys.argv[2:])
