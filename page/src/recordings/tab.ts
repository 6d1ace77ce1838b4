// A tab of the results. Each stands in a file of the folder tabs, which has it as its default export: label, content and styles.
import type { ComponentType } from 'preact';

export interface Tab {
  /** In the session and in the page's elements. */
  name: string;
  /** In sessions of earlier versions. */
  former?: string;
  title: string;
  /** Tabs stand in the order of these numbers. */
  place: number;
  /** Behind the title; drawn like a component, and so may use stores. */
  Note?: ComponentType;
  /** Whether it shows the feature that is chosen beside the tabs. */
  measures?: boolean;
  Content: ComponentType;
}
