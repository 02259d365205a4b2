// The controls under a picture: play, frame by frame, the slider, the rate, and back to the present of a running job.
import { button, h, setText } from "../dom/element";
import { iconButton, setIcon } from "../dom/icons";
import { kRates, type Player } from "./player";

const kSteps = 1000; // of the slider

export interface PlayerBarOptions {
  /** The value of the next (1) or previous (-1) frame. */
  neighbour(direction: 1 | -1): number;
  /** The place as text, such as "strain 0.40". */
  text(value: number): string;
  fit?(): void;
}

export class PlayerBar {
  readonly element: HTMLElement;
  private readonly play = iconButton("play", "Play (space)", () => this.player.toggle());
  private readonly slider = h("input", { type: "range", min: 0, max: kSteps, step: 1, class: "slider",
                                         "aria-label": "Place in the crush" });
  private readonly text = h("output", { class: "place" });
  private readonly live = button("Live", () => this.player.follow(), { class: "live", title: "Follow the running job",
                                                                       hidden: true });
  private readonly rate = h("select", { "aria-label": "Rate of play", title: "1 plays the whole crush in 10 s" },
    ...kRates.map((rate) => h("option", { value: rate }, `${rate}×`)));

  constructor(private readonly player: Player, private readonly options: PlayerBarOptions) {
    this.rate.value = "1";
    this.rate.addEventListener("change", () => player.setRate(Number(this.rate.value)));
    this.slider.addEventListener("input", () => player.seek((Number(this.slider.value) / kSteps) * player.fullEnd));
    this.element = h("div", { class: "player" },
      this.play,
      iconButton("previous", "Previous frame (left arrow)", () => player.seek(options.neighbour(-1))),
      iconButton("next", "Next frame (right arrow)", () => player.seek(options.neighbour(1))),
      this.slider, this.text, this.live, this.rate,
      options.fit && iconButton("fit", "Show the whole specimen (0)", () => options.fit?.()));
    player.changes.add(() => this.update());
    this.update();
  }

  setLive(isLive: boolean): void {
    this.live.hidden = !isLive;
  }

  private update(): void {
    const { player } = this;
    setIcon(this.play, player.playing ? "pause" : "play", player.playing ? "Pause (space)" : "Play (space)");
    this.slider.value = String(Math.round((kSteps * player.value) / player.fullEnd));
    const text = this.options.text(player.value);
    setText(this.text, text);
    this.slider.setAttribute("aria-valuetext", text);
    this.live.setAttribute("aria-pressed", String(player.following));
  }

  /** Keys of the page: space, arrows, Home, End, 0. Returns whether the key was one of them. */
  key(event: KeyboardEvent): boolean {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.closest("input:not(.slider), select, dialog")) {
      return false;
    }
    const onButton = target.closest("button, a, summary") !== null;
    switch (event.key) {
      case " ": if (onButton) return false; this.player.toggle(); break;
      case "ArrowLeft": this.player.seek(this.options.neighbour(-1)); break;
      case "ArrowRight": this.player.seek(this.options.neighbour(1)); break;
      case "Home": this.player.seek(0); break;
      case "End": this.player.seek(this.player.end); break;
      case "0": this.options.fit?.(); break;
      default: return false;
    }
    event.preventDefault();
    return true;
  }
}
