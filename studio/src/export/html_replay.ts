// The page itself with a recording inside: one file that opens from disk, with no server and no engine.
import type { Recording } from '../sources/recording';
import { recordingText } from '../sources/recording_bytes';

export const replayElement = 'acus-replay';

const text = async (address: string): Promise<string> => {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`the page could not read its own ${address} (${answer.status})`);
  return answer.text();
};
// Nothing inside a script may end it.
const guarded = (script: string): string => script.replaceAll(/<\/(script)/gi, '<\\/$1').replaceAll('<!--', '<\\!--');

export async function replayPage(recording: Recording): Promise<string> {
  const page = new DOMParser().parseFromString(await text(document.baseURI.split('#')[0]!), 'text/html');
  const resolve = (address: string) => new URL(address, document.baseURI).href;
  for (const link of page.querySelectorAll<HTMLLinkElement>('link[rel=stylesheet]')) {
    const style = page.createElement('style');
    style.textContent = await text(resolve(link.getAttribute('href')!));
    link.replaceWith(style);
  }
  const scripts: string[] = [];
  for (const script of page.querySelectorAll<HTMLScriptElement>('script[src]')) {
    scripts.push(guarded(await text(resolve(script.getAttribute('src')!))));
    script.remove();
  }
  const kept = page.createElement('script');
  kept.type = 'text/plain';
  kept.id = replayElement;
  kept.textContent = await recordingText(recording);
  page.body.append(kept);
  page.title = `${recording.label}: acus replay`;
  for (const source of scripts) {
    const script = page.createElement('script');
    script.type = 'module';
    script.textContent = source;
    page.body.append(script);
  }
  return `<!doctype html>\n${page.documentElement.outerHTML}`;
}
