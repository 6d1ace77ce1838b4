// Light, dark, or as the system says. The choice stays in the browser and is marked at the root for the style sheet.
import { store } from './store';

export type ThemeChoice = 'system' | 'light' | 'dark';
const place = 'rheocyte-theme';
const dark = window.matchMedia('(prefers-color-scheme: dark)');

function storedChoice(): ThemeChoice {
  const found = window.localStorage.getItem(place);
  return found === 'light' || found === 'dark' ? found : 'system';
}

export const themeChoice = store<ThemeChoice>(storedChoice());
/** The theme in force; canvases draw themselves again when it changes. */
export const theme = store<'light' | 'dark'>('light');

function apply(): void {
  const choice = themeChoice.get();
  const shown = choice === 'system' ? (dark.matches ? 'dark' : 'light') : choice;
  document.documentElement.dataset.theme = shown;
  theme.set(shown);
}

export function startTheme(): void {
  dark.addEventListener('change', apply);
  themeChoice.subscribe((choice) => {
    window.localStorage.setItem(place, choice);
    apply();
  });
  apply();
}

/** A colour of the style sheet, for what is drawn on a canvas: token('--ink'). */
export const token = (name: string): string =>
  window.getComputedStyle(document.documentElement).getPropertyValue(name).trim();
