declare module 'virtual:presets' {
  const presets: { id: string; group: string; title: string; words: string; toml: string }[];
  export default presets;
}
