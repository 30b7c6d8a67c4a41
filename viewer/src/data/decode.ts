import type { GroupJson, ReplayJson, ReportJson, TimesJson } from './format';
import type { Group, Replay } from './recording';

export function decodeFloats(text: string): Float64Array {
  const bytes = atob(text);
  const view = new DataView(new ArrayBuffer(bytes.length));
  for (let i = 0; i < bytes.length; i++) view.setUint8(i, bytes.charCodeAt(i));
  const values = new Float64Array(bytes.length / 4);
  for (let i = 0; i < values.length; i++) values[i] = view.getFloat32(4 * i, true);
  return values;
}

export function decodeTimes(times: TimesJson): Float64Array {
  if ('values' in times) return decodeFloats(times.values);
  return Float64Array.from({ length: times.count }, (_, i) => times.start + i * times.step);
}

export function decodeGroups(report: ReportJson): Group[] {
  const times = report.times.map(decodeTimes);
  const decodeGroup = (group: GroupJson): Group => ({
    title: group.title,
    caption: group.caption,
    lanes: group.lanes,
    axes: group.axes.map((axes) => ({
      ...axes,
      series: axes.series.map((s) => ({ ...s, t: times[s.time], values: decodeFloats(s.values) })),
    })),
    paths: group.paths.map((path) => ({
      title: path.title,
      xLabel: path.x_label,
      yLabel: path.y_label,
      unit: path.unit,
      series: path.series.map((s) => ({
        ...s,
        t: times[s.time],
        x: decodeFloats(s.x),
        y: decodeFloats(s.y),
      })),
    })),
  });
  return report.groups.map(decodeGroup);
}

export function decodeReplay(replay: ReplayJson, times: TimesJson[]): Replay {
  return {
    urdf: replay.urdf,
    t: decodeTimes(times[replay.time]),
    followedLink: replay.followed_link,
    bodies: replay.bodies.map((b) => ({ link: b.link, poses: decodeFloats(b.poses) })),
    joints: replay.joints.map((j) => ({ name: j.name, angles: decodeFloats(j.angles) })),
    frames: replay.frames.map((f) => ({ ...f, poses: decodeFloats(f.poses) })),
    forces: replay.forces.map((f) => ({
      name: f.name,
      kind: f.kind,
      points: decodeFloats(f.points),
      forces: decodeFloats(f.forces),
    })),
    objects: replay.objects.map((o) => ({
      name: o.name,
      size: o.size,
      poses: decodeFloats(o.poses),
    })),
  };
}
