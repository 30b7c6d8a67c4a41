// Paper gets its own drawing: light colours, the width of the page, more pixels per millimetre.
export const paperWidth = 696; // of a plot on an A4 page [CSS px]
export const paperSceneHeight = 300;
export const paperSharpness = 3;

export function onPrint(before: () => void, after: () => void): void {
  const root = document.documentElement;
  window.addEventListener('beforeprint', () => {
    root.classList.add('printing');
    before();
  });
  window.addEventListener('afterprint', () => {
    root.classList.remove('printing');
    after();
  });
}
