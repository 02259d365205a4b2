import { h } from '../dom/element'; import type { View } from '../router';
export class ComparePage implements View { title=''; element=h('div'); constructor(_: unknown) {} destroy(): void {} }
