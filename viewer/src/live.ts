import { showLive } from './live/live_page';
import type { SceneJson } from './live/live_format';

void fetch('scene.json')
  .then((answer) => answer.json() as Promise<SceneJson>)
  .then((scene) => {
    document.title = `Live: ${scene.title}`;
    showLive(scene, new EventSource('events'), document.getElementById('live')!);
  });
