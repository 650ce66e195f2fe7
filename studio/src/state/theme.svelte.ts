// Light or dark: as the system has it, or as the person chose.
export type ThemeChoice = 'system' | 'light' | 'dark';

const key = 'acus.theme';
const dark = window.matchMedia('(prefers-color-scheme: dark)');

const remembered = (): ThemeChoice => {
  try {
    const kept = localStorage.getItem(key);
    return kept === 'light' || kept === 'dark' ? kept : 'system';
  } catch {
    return 'system'; // a page from disk may have no storage
  }
};

class Theme {
  choice = $state<ThemeChoice>(remembered());
  private system = $state(dark.matches);

  constructor() {
    dark.addEventListener('change', () => {
      this.system = dark.matches;
      this.apply();
    });
    this.apply();
  }

  get isDark(): boolean {
    return this.choice === 'system' ? this.system : this.choice === 'dark';
  }

  choose(choice: ThemeChoice): void {
    this.choice = choice;
    try {
      localStorage.setItem(key, choice);
    } catch {
      // not kept, but in force
    }
    this.apply();
  }

  private apply(): void {
    document.documentElement.dataset.theme = this.isDark ? 'dark' : 'light';
  }
}

export const theme = new Theme();
export const token = (name: string): string => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
